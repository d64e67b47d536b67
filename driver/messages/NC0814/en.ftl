NC0814 = subprogram { $name } is never called
    .label = no block of the text calls it
    .help = delete it, or call it
