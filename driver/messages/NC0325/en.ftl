NC0325 = check at the machine: the cut after an optional stop
    .label = with the switch on, { $source } and { $target } differ here
    .help = program `M03` and `M08` after `M01` in the source, as the cut needs them
