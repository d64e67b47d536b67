NC0305 = the only work offset taken for { $offset }
    .label = first used here
    .help = set this offset to the work zero that the part has on the other machine
