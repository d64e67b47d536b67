NC0338 = `{ $cycle }` beside `{ $motion }` drills a hole
    .label = on other controls the motion code cancels the cycle
    .help = delete `{ $motion }`; or state `--from-option cycle_beside_motion=drilled` or `=cancelled`
NC0338-question = does the cycle beside a motion drill?
NC0338-question-hole = { $cycle } beside { $motion }: a hole, or a move without one?
