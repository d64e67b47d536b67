NC0414 = { $holes } holes written as the cycle { $kind }
    .label = separate moves here
