NC0405 = { $kind } cycle written as moves
    .label = { $target } has no code for it
    .account = { $kind } cycle into its moves
