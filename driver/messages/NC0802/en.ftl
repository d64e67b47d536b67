NC0802 = feed above the highest of the machine
    .label = { $feed } mm/min, and the highest is { $limit }{ $more ->
        [0] {""}
        [one] ; one more move too
       *[other] ; { $more } more moves too
    }
    .help = the control cuts with its highest feed, or stops
NC0802-axis = feed above the highest of { $axis }
    .label = { $feed } mm/min, and the highest is { $limit }{ $more ->
        [0] {""}
        [one] ; one more move too
       *[other] ; { $more } more moves too
    }
    .help = the control cuts with its highest feed, or stops
