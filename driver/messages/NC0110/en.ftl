NC0110 = the program has no end code
    .label = the text ends here
    .help = is the file complete? If it is, add the end code, such as M30
