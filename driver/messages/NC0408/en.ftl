NC0408 = { $count } block { $count ->
        [one] number
       *[other] numbers
    } left out
    .label = the first one
