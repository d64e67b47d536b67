NC0503 = the arc is too small for { $target }
    .label = both ends become one point in its least increment
    .help = delete this arc: it is below the least increment
