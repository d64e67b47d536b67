NC0443 = message kept as a comment
    .label = { $target } shows none while the program runs
    .account = messages, as comments
