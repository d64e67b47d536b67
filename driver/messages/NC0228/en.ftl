NC0228 = label `{ $name }` is not where this block looks for it
    .label = used here
    .help = write the label before the block that repeats from it, or where the jump searches
