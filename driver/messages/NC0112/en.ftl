NC0112 = blocks before the only `{ $mark }`
    .label = the control starts at the mark and finds no blocks
    .help = add a line with `{ $mark }` before the first block, or delete this line
