NC0607 = nothing in the program calls the subprogram { $name }
    .label = translated, but not executed in the verification
    .help = check the output of this subprogram
