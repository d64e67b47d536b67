NC0342 = T{ $number } is { $name }
    .label = numbered in the order of use: put it into this pocket
    .account = T{ $number } is { $name }, numbered in the order of use
