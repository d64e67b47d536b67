NC0112 = blocks before the only `{ $mark }`
    .label = the control starts at the mark and finds no blocks
    .help = add a line with `{ $mark }` before the first block, or delete this line
NC0112-between = blocks before and after the first `{ $mark }`
    .label = the control starts reading at this mark
    .help = to keep the blocks before it, add a line with `{ $mark }` before the first one
    .help-delete = to keep those after it, delete the blocks before it
