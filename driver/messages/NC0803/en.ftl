NC0803 = spindle speed above the highest of the machine
    .label = { $speed } rev/min, and the highest is { $limit }
    .help = the spindle turns with its highest speed, or the control stops
