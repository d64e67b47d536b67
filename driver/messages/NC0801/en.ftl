NC0801 = { $axis } goes beyond its travel
    .label = machine coordinate { $to }{ $unit }, { $side ->
        [below] below its least
       *[above] above its greatest
    }, { $limit }{ $unit }{ $more ->
        [0] {""}
        [one] ; one more move too
       *[other] ; { $more } more moves too
    }
    .help = move the work, or state the work offset and the tool length that are really set
NC0801-farthest = { $axis } goes beyond its travel
    .label = machine coordinate { $to }{ $unit }, { $side ->
        [below] below its least
       *[above] above its greatest
    }, { $limit }{ $unit }{ $more ->
        [0] {""}
        [one] ; one more move too
       *[other] ; { $more } more moves too
    }, the farthest to { $farthest }{ $unit }
    .help = move the work, or state the work offset and the tool length that are really set
