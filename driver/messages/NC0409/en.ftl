NC0409 = program name kept as a comment
    .label = { $target } has no place for it
    .account = the program name, as a comment
