NC0433 = peck as deep as its hole
    .label = { $target } stops with an alarm at a deeper first peck
    .account = pecks that are longer than their holes
