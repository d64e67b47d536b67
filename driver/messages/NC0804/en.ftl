NC0804 = feed move without a feed
    .label = no F before this block
    .help = program F in this block or before it
