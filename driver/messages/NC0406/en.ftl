NC0406 = program `{ $name }` written { $times } { $times ->
        [one] time
       *[other] times
    } in place of its call
    .label = the call
    .account = program { $name } where it is called
