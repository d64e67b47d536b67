NC0340 = cutter compensation computed as RS274/NGC defines it
    .label = corners, lead-in and lead-out differ by control
    .help = check corners and both ends of the contour on the machine
