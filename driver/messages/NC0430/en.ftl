NC0430 = polar point written in coordinates
    .label = { $target } has no code for it
    .account = polar points into coordinates
