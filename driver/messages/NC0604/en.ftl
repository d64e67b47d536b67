NC0604 = { $variable } is read before the program sets it
    .label = ncc used the same test values in both programs
    .help = set it on the new machine as on the old one
