NC0102 = `{ $text }` is not a number
    .label = at most 18 digits, one sign and one decimal point
    .help = write digits with at most one sign and one decimal point: `-12.5`
