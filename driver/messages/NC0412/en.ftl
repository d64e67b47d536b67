NC0412 = repetition unrolled { $times } { $times ->
        [one] time
       *[other] times
    }
    .label = { $target } has no code for it
    .account = a repetition into its blocks
