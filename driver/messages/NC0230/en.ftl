NC0230 = thread without a spindle speed
    .label = no S before this block
    .help = program the spindle speed before this block
