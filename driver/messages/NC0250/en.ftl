NC0250 = this corner cannot be made: { $what }
    .label = this corner
    .help = check the size of the corner; a line or arc in the same plane must follow it
