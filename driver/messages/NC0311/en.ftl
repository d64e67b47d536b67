NC0311 = corners by { $path } assumed
    .label = { $target } has no code for it and always does it
    .help = compare corners on the machine with the program
