NC0522 = does { $axis } turn by { $by } degrees here, or by { $or }?
    .label = a setting decides, on { $source } and on { $target }
    .help-state = state how { $control } turns it: `--{ $side }-option { $option }={ $value }` (by { $by }) or `={ $other }` (by { $or })
    .help = or turn it by less than half a turn in each block
NC0522-question = how far does a rotary axis turn here?
