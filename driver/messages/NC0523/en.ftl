NC0523 = { $kind ->
        [macro] macro calls
       *[call] calls
    } are nested { $depth } deep, { $target } takes { $most }
    .label = the call of `{ $name }` is the first too many
    .help-option = if your control takes { $depth }: `--to-option { $option }={ $depth }`
    .help = merge the blocks of some subprograms into those that call them
