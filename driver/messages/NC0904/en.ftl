NC0904 = the shank runs into material
    .label = { $tool }, { $depth } mm deep at { $place }{ $more ->
        [0] {""}
        [one] ; one more move
       *[other] ; { $more } more moves
    }
    .help = take a tool with longer flutes, or cut the wall free first
