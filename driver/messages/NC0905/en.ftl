NC0905 = the holder runs into material
    .label = { $tool }, { $depth } mm deep at { $place }{ $more ->
        [0] {""}
        [one] ; one more move
       *[other] ; { $more } more moves
    }
    .help = clamp the tool longer, or cut the wall free first
