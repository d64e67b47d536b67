NC0308 = not stated: { $name }
    .label = assumed: { $value }
    .help = compare with the parameter on your machine
