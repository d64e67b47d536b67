NC0329 = check at the machine: corners are rounded without a tolerance
    .label = { $source } rounds them by axis lag, { $target } by acceleration
    .help = state the corner deviation of the source machine: `--from-option path_tolerance=0.02`; or program a tolerance
