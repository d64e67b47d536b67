NC0718 = no [[programs]] in the project file
    .label = the file has no rows
    .help = `ncc init PROGRAM --to DIALECT` writes one
