NC0304 = tool length offset takes effect at the next Z move
    .label = written into the next block with a Z
    .help = check the first Z after it
