NC0450 = corner written as an arc or a line
    .label = { $target } has no code for this corner
    .account = rounded and chamfered corners into arcs and lines
