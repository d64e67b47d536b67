NC0314 = { $code } is what your program makes of it
    .label = `{ $program }` says what the block does
    .help = check the moves of this block
    .account = { $code } is what your program `{ $program }` makes of it
