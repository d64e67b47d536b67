NC0327 = check at the machine: the next run starts at another position
    .label = { $source } starts it with { $axis } shifted by { $before }, { $target } by { $after }
    .help = cancel the shift before the end of the source program, or set it at its start
