NC0608 = every call must pass { $name }{ $place ->
        [0] {""}
       *[other] {""} in place { $place }
    }
    .label = { $target } reads 0 for an argument that a call omits
    .help = check each call of this macro
    .help-zero = check each call: it must pass { $name }, also where it is zero
    .help-whole = check each call: { $name } must be a whole number in each
    .help-left-out = check each call: ncc does not translate one that omits { $name }
    .help-default = check each call: one that relied on this default must pass { $value }
NC0608-null = every call must pass { $name }{ $place ->
        [0] {""}
       *[other] {""} in place { $place }
    }
    .label = an argument that a call omits is empty on { $target }
    .help = check each call of this macro
    .help-zero = check each call: it must pass { $name }, also where it is zero
    .help-whole = check each call: { $name } must be a whole number in each
NC0608-whole = every call must pass { $name }{ $place ->
        [0] {""}
       *[other] {""} in place { $place }
    }, a whole number
    .label = { $target } rounds it; it is empty if a call omits it
    .help-whole = check each call: { $name } must be a whole number in each
NC0608-check = every call must pass { $name }{ $place ->
        [0] {""}
       *[other] {""} in place { $place }
    }
    .label = check left out: { $target } reads 0 for an omitted argument
    .help-left-out = check each call: ncc does not translate one that omits { $name }
    .help-default = check each call: one that relied on this default must pass { $value }
