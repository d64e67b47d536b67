NC0104 = the block is longer than { $limit } bytes
    .label = this block
    .help = check the line ends: some transfers strip them
