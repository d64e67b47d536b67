NC0716 = two rows of [[programs]] match { $program }
    .label = which machine is it for?
    .help = let one of the patterns match fewer files
