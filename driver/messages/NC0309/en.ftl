NC0309 = { $pattern }: holes assumed in the programmed order
    .label = a control may start at another hole
    .help = check that the order of the holes does not matter
