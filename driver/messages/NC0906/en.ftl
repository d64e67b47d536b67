NC0906 = the tool runs into a fixture
    .label = { $tool }, { $depth } mm deep at { $place }{ $more ->
        [0] {""}
        [one] ; one more move
       *[other] ; { $more } more moves
    }
    .help = go around the fixture, or check its position and the work offset
