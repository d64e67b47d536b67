NC0505 = the profile of { $machine } says otherwise
    .label = this needs { $fact }
    .help = write this block another way, or correct the profile
