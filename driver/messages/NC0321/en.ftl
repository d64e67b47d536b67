NC0321 = tilted plane: same swivel assumed
    .label = the machine decides how its axes move to the plane
    .help = swivel to each plane first, with the tool far from the work
