NC0113 = `{ $what }` is evaluated last
    .label = AND, OR, XOR and NOT come before comparisons here
    .help = put each comparison in parentheses
