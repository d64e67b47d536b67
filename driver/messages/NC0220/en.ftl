NC0220 = macro statement not supported: { $what }
    .label = a variable, an expression or a jump
    .help = write the values out, or edit this block by hand
    .help-code = if the program never sets #{ $variable }, state the code: `--value { $variable }=8` for M8
