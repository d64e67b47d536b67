NC0203 = `{ $first }` and `{ $second }` in the same block
    .label = both belong to one modal group: one must go
    .related = the other one
    .help = delete one of them, or write each in its own block, in the order in which they act
