NC0424 = text for a device left out
    .label = { $target } does not write it; kept as a comment
    .account = text for a device or a file left out
    .help = check that no system waits for this text
