NC0105 = this file is not a part program
    .label = no text file has these bytes
    .help = choose the part program itself: a text file with one block per line
