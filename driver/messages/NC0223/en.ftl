NC0223 = hole positions without a canned cycle
    .label = no cycle is active here
    .related = the cycle's block
    .help = program the cycle before the positions
