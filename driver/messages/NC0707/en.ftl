NC0707 = travel upside down
    .label = the lower end comes first
