NC0601 = ncc made a mistake; no program was written
    .label = the first move that differs
    .help = this is an internal error of ncc, not an error of your program
    .help-report = please report it with the program, or the blocks around this one
