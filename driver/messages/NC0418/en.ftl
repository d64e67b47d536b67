NC0418 = { $kind } left out: no effect on the cut
    .label = { $target } has no such code; the programmed moves stay
    .account = { $kind } left out
