NC0111 = text after the end of the program
    .label = the control never reaches this text
    .related = the program ends here
    .help = delete it, or move the end of the program after it
