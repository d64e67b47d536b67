NC0222 = feed move without a feed
    .label = no F, F0, or F with an empty variable
    .help = write F with a value above zero in this block or before it
