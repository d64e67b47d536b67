NC0444 = `{ $code }` left out
    .label = stated to have no effect on the cut
    .account = { $code } left out, as stated
