NC0326 = check at the machine: the program sets no path mode
    .label = corners: { $before } on { $source }, { $after } on { $target }
    .help = program the path mode at the start: exact stop, or path blending with its tolerance
