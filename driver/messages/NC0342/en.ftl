NC0342 = T{ $number } is { $name }
    .label = numbered in the order of use: put it into this pocket
