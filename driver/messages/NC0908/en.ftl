NC0908 = not simulated: a cut with the part turned
    .label = a rotary axis moves here, or has turned the part
    .help = split the program where the part is turned, and simulate each piece
NC0908-tilted = not simulated: a cut on a tilted plane
    .label = the tool does not stand along Z of the part here
    .help = split the program where the plane changes, and simulate each piece
