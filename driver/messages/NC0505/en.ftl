NC0505 = the profile of { $machine } states otherwise
    .label = this needs { $fact }
    .help = write this block without it, or correct the profile
