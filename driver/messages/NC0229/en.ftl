NC0229 = no circle fits these words
    .label = this arc
    .help = check the angle (more than 0, less than 360), and that the points are not on one line
