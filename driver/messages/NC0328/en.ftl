NC0328 = check at the machine: the next run starts in another frame
    .label = one control keeps a rotation, scale or mirror at the end
    .help = cancel it before the end of the source program, or set it at its start
