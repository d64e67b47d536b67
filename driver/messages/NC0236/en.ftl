NC0236 = the call of `{ $name }` is nested in { $most } others
    .label = no control nests so deep: it stops with an alarm
    .help = merge some called blocks into the programs that call them
