NC0804 = feed move without a feed
    .label = no F before this block, or F0
    .help = write F with a value above zero in this block or before it
