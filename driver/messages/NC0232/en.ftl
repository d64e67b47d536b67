NC0232 = { $variable } is read but never set
    .label = only the control knows its value
    .help = set the variable before this block
    .help-value = or state its value: `--value { $name }=NUMBER`
