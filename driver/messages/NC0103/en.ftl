NC0103 = the comment is not closed
    .label = opened here, still open at the end of the line
    .help-close = close it with `{ $close }` on the same line
