NC0218 = program `{ $name }` calls itself
    .label = this call never ends
    .related = through this call
