NC0209 = `{ $word }` is out of range
    .label = this word cannot have this value
