NC0713 = { $key }: the dialect has no { $lacks }
    .label = cannot be written
