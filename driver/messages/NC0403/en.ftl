NC0403 = { $word } rounded to { $written }
    .label = finer than the least increment of { $target }
