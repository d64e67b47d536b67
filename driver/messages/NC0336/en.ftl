NC0336 = T{ $named } beside M06 taken for the new tool
    .label = T{ $waiting } was preselected, and the next H is H{ $waiting }
    .help = state what your machine does: `--from-option tool_with_change=named` or `=waiting`
