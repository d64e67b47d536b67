NC0207 = too many { $letter } codes in one block
    .label = { $source } takes { $limit } { $letter } { $limit ->
        [one] code
       *[other] codes
    } in a block
    .help = write the codes in several blocks
