NC0233 = ncc cannot write this run-time value for { $target }
    .label = this is { $what }
    .help = `--pass flatten` executes the program and writes the resulting blocks
