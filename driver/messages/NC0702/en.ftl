NC0702 = there is no dialect `{ $name }`
    .label = not a known dialect
    .help = `ncc dialects` lists them
