NC0210 = no motion mode is active
    .label = rapid move or feed move?
    .help = write the motion code before the first axis word: `G00` or `G01`
