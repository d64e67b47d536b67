NC0114 = text before the first `{ $mark }`
    .label = the control skips it, and ncc skips it too
    .help = delete it, or make it a comment after the program number
