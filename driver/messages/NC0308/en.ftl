NC0308 = { $parameter } assumed to be { $value }
    .label = a parameter of the machine decides
    .help = compare with the parameter on your machine
