NC0403 = `{ $word }` rounded to `{ $written }`
    .label = finer than the least increment of { $target }
    .account = numbers, to the digits of { $target }
