NC0902 = cut with the spindle stopped
    .label = { $tool }, { $depth } mm deep at { $place }{ $more ->
        [0] {""}
        [one] ; one more move
       *[other] ; { $more } more moves
    }
    .help = start the spindle before this move
