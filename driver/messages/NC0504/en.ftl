NC0504 = `{ $word }` is out of range on { $target }
    .label = cannot be written
