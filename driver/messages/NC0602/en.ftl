NC0602 = ncc made a mistake: it cannot read its own output
    .label = the output for this block gives { $code }
    .help = this is an internal error of ncc, not an error of your program
    .help-report = please report it with the program, or the blocks around this one
