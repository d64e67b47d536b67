NC0307 = `{ $option }` assumed to be `{ $value }`
    .label = no source states it
    .help = decide it with `--{ $side }-option { $option }=…`; see `ncc dialects show`
NC0307-question = arc centres (I J K): from the start of the arc or from zero?
