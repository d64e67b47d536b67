NC0324 = check at the machine: this tool change moves Z to machine zero
    .label = { $target } does this, { $source } does not
    .help = check that the path up is free
