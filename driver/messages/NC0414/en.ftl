NC0414 = { $holes } holes folded into the cycle { $kind }
    .label = separate moves here
    .account = moves into the { $kind } cycle ({ $holes } { $holes ->
        [one] hole
       *[other] holes
    })
