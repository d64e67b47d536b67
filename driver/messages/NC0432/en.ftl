NC0432 = written as a cut in machine coordinates
    .label = { $target } has a code for a point without the offsets
    .account = points without the offsets into cuts in machine coordinates
