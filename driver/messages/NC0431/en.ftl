NC0431 = cut in machine coordinates written in the work offset
    .label = { $target } only moves rapidly there; the same point in { $offset }
    .account = cuts in machine coordinates into { $offset }, without the offsets
