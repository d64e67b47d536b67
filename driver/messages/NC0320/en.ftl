NC0320 = tool centre point control: same rotary axes and zero assumed
    .label = the machine decides axes, directions and zeros
    .help = check the rotary axes, their directions, and whether the zero turns with the work
