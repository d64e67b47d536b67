NC0805 = feed move with the spindle stopped
    .label = no M03 or M04 with a speed is active here
    .help = write `M03` before this block, with a speed: `S1000 M03`
