NC0330 = read as { $taken }; { $other } reads it differently
    .label = the first difference between both readings
    .help = name the control: `--from { $taken }` or `--from { $other }`
NC0330-question = { $one } or { $two }? The text fits both
