NC0604 = variable { $name } is read before the program sets it
    .label = ncc used the same test values in both programs
