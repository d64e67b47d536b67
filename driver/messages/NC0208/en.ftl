NC0208 = decimal point in `{ $word }`
    .label = this word takes a whole number
    .help = write a whole number
    .help-whole = write `{ $whole }`
