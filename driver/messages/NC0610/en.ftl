NC0610 = { $option } on { $control }: the other value was only partly tried
    .label = that run stopped after 1000000 events or 20000000 steps
    .help = state what your machine does: `--{ $side }-option { $option }=VALUE`
NC0610-stop = the switch for optional stops was only partly tried
    .label = that run stopped after 1000000 events or 20000000 steps
    .help = check the output after the optional stop
