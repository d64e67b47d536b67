NC0813 = blocks that are never reached
    .label = the jump before is unconditional, and no jump leads here
    .help = delete them, or give them a number that a jump uses
NC0813-end = blocks after the end of the program
    .label = never executed, like all blocks after them
    .help = delete them, or the end before them
