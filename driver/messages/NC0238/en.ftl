NC0238 = the { $mode } at the end is not the one of the start
    .label = the program starts again here with other modes
    .help = program the code of the { $mode } at the start of the program
