NC0423 = a value in a message has { $digits } decimal places
    .label = { $target } shows trailing zeros
    .account = values in messages, with { $digits } decimal places
