NC0812 = there is no block { $name }
    .label = the target of this jump is missing
    .help = give a block this number or label, or correct the jump
