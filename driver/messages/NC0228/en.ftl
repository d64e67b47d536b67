NC0228 = label `{ $name }` is not where this block looks for it
    .label = used here
    .help = put the label before the block that repeats from it, or where the jump searches
