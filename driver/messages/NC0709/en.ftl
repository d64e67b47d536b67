NC0709 = { $key } is missing
    .label = { $why }
