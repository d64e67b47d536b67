NC0350 = a milling program assumed; it looks like { $looks }
    .label = by this text
    .help = make sure that the program is for a mill
