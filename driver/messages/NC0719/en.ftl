NC0719 = there is no folder `{ $name }`
    .label = seen from the folder of this file
    .help = make it, or correct its name
