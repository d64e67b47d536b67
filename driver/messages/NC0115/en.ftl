NC0115 = { $name } occurs more than once in this program
    .label = the control jumps to the first one that it finds
    .related = one of them
    .help = give each jump target its own block number
