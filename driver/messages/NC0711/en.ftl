NC0711 = two codes for { $function }
    .label = the second one
    .help = ncc can write only one of them: keep one, or give them two names
