NC0222 = feed move without a feed
    .label = no F in the active feed mode
    .help = program F in this block or before it
