NC0338 = `{ $cycle }` beside `{ $motion }` drills a hole
    .label = on other controls the motion code cancels the cycle
    .help = delete `{ $motion }`; or state `--from-option cycle_beside_motion=drilled` or `=cancelled`
