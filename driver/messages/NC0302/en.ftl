NC0302 = `{ $code }` assumed to have no effect
    .label = no manual names an effect; kept as a comment
    .help = if your manual names an effect, do not use the output
