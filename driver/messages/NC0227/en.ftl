NC0227 = the program runs too long to be executed
    .label = still running after { $steps } blocks
    .help = use fewer iterations for a trial, or check that its loops end
