NC0521 = { $target } refuses { $what } under cutter compensation
    .label = compensation is active here, or may be
    .help = move it before the block that starts compensation, or after the block that ends it
