NC0710 = { $code } is already in the dictionary of the dialect
    .label = there it is { $means }
    .help = delete it: the dictionary holds for every machine of the dialect
