NC0301 = { $mode }: { $value } assumed
    .label = the program relies on it and never sets it
    .help-machine = check that the machine is set up like this at the start of the program
    .help-program = to be sure, program the { $mode } at the start of the program
NC0301-question = mm or inch? The program never states its unit
