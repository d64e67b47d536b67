NC0345 = check at the machine: set the Z zero for tool { $tool } by hand
    .label = { $target } has no tool lengths; the change is by hand
    .help = touch off this tool before the program continues, and check its first Z move
