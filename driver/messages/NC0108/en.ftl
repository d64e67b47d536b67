NC0108 = nothing to translate
    .label = the main program has no blocks
    .help = the file is empty or has only comments: is it the right file?
