NC0206 = `{ $letter }` twice in one block
    .label = the second one
    .related = first here
    .help = keep one of the two
