NC0705 = the dialect has no row `{ $row }`
    .label = no row to confirm
    .help = `ncc dialects show` lists the rows; `ncc doctor` writes the keys that a program needs
