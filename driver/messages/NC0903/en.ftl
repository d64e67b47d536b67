NC0903 = cut deeper than the flutes are long
    .label = { $tool }, { $depth } mm above its flutes at { $place }{ $more ->
        [0] {""}
        [one] ; one more move
       *[other] ; { $more } more moves
    }
    .help = cut in more steps, or take a tool with longer flutes
