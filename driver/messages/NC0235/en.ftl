NC0235 = { $source } refuses { $what } under cutter compensation
    .label = cutter compensation is active here
    .help = move it before the block that starts compensation, or after the block that ends it
