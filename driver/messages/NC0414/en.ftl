NC0414 = { $holes } holes written as the cycle { $kind }
    .label = separate moves here
    .account = moves into the { $kind } cycle ({ $holes } { $holes ->
        [one] hole
       *[other] holes
    })
