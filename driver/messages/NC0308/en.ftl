NC0308 = assumed: { $fact }
    .label = a parameter of the machine decides
    .help = compare with the parameter on your machine
