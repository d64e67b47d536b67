NC0234 = this loop never ends
    .label = all values are those of an iteration before
