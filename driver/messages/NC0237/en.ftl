NC0237 = interrupted
    .label = the program was here, after { $steps } blocks
