NC0811 = program { $name } is not in the text
    .label = not checked
    .help = it must be in the memory of the control when the program runs
