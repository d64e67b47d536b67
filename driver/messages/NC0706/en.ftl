NC0706 = { $what } twice
    .label = the second one
    .help = keep one of the two
