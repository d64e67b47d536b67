NC0901 = rapid move through material
    .label = { $tool }, { $depth } mm deep at { $place }{ $more ->
        [0] {""}
        [one] ; one more move
       *[other] ; { $more } more moves
    }
    .help = lift the tool before this move, or check the raw part and the work offset
