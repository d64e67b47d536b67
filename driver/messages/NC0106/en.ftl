NC0106 = `{ $letter }` without a number
    .label = { $source } does not read this as zero
    .help = if you mean zero, write `{ $letter }0`
