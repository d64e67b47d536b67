NC0404 = hole pattern written as { $holes } { $holes ->
        [one] position
       *[other] positions
    }
    .label = { $target } has no code for it
    .account = a hole pattern into its { $holes } positions
