NC0407 = block-skip level { $level } lost
    .label = { $target } cannot distinguish this switch from the others
    .account = block-skip level { $level } has no switch of its own
    .help = tell the operator: the switches can no longer be used one by one
