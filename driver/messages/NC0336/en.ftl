NC0336 = T{ $named } beside M06 taken for the new tool
    .label = T{ $waiting } was preselected, and the next H is H{ $waiting }
    .help = state what your machine does: `--from-option tool_with_change=named` or `=waiting`
NC0336-question = does M06 change to the tool of its block, or to the preselected one?
NC0336-question-tools = does M06 change to T{ $one } or T{ $two }? The next H is H{ $two }
