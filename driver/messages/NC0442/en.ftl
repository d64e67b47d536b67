NC0442 = feed of linear and rotary axes written as inverse time
    .label = { $source } and { $target } count F differently here
    .account = feed of linear and rotary axes, as inverse time
