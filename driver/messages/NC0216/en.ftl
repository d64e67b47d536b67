NC0216 = the position of { $axis } is not known
    .label = this block depends on it
    .help = program an absolute { $axis } word before this block
    .help-start = or state the position at the start of the program: `--start { $axis }100`
