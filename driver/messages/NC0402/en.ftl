NC0402 = centre of the arc rewritten
    .label = in the form that { $target } takes
    .account = arc centres, in the form of { $target }
