NC0225 = this depends on the { $mode }, which only the caller sets
    .label = this subprogram never sets it
    .help = set it in the subprogram itself
NC0225-units = inch or mm? This subprogram never says
    .label = this length depends on the caller
    .help = add `{ $mm }` (mm) or `{ $inch }` (inch) to the subprogram, as its caller has it
