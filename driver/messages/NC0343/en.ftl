NC0343 = check at the machine: the next run reads other values of { $count ->
        [one] variable
       *[other] variables
    } { $names }
    .label = kept { $before } on { $source }, { $after } on { $target }
    .help = set the variable before the program reads it, or by hand at the start of each shift
