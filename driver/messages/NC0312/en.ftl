NC0312 = cutter compensation: lead-in and lead-out may differ
    .label = each control computes its own; the contour is the same
    .help = check lead-in and lead-out with the tool above the part, and the radius in its table
