NC0703 = the dialect has no option `{ $option }`
    .label = no such option
    .help-has = it has: { $has }
NC0703-none = the dialect has no option `{ $option }`
    .label = this dialect has no options
