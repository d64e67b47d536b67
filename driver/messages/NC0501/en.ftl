NC0501 = { $target } has no words for this: { $what }
    .label = cannot be written
