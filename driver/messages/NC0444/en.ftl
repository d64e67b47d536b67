NC0444 = { $code } left out
    .label = stated to have no effect on the cut
    .account = { $plain } left out, as stated
