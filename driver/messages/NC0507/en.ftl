NC0507 = the program never sets its { $mode }
    .label = { $target } always starts with its own
    .help = set it at the start of the program
