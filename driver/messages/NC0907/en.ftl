NC0907 = the tool goes below the table
    .label = { $tool }, { $depth } mm deep at { $place }{ $more ->
        [0] {""}
        [one] ; one more move
       *[other] ; { $more } more moves
    }
    .help = check Z of this move, the work offset and the length of the tool
