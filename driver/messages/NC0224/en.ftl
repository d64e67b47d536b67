NC0224 = R plane below the bottom of the hole
    .label = the tool would drill upwards
    .related = the cycle's block
    .help = check the signs of the hole bottom and of the R plane
