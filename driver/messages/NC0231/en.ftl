NC0231 = an expression has no value
    .label = this is { $what }
    .help = check the values of its variables: a control stops with an alarm
