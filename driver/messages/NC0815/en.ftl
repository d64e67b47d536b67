NC0815 = thread pitch { $pitch } mm: no standard thread has it
    .label = the nearest usual pitch is { $nearest } mm{ $more ->
        [0] {""}
        [one] ; one more hole too
       *[other] ; { $more } more holes too
    }
    .help = feed = speed × pitch: compare F and S with the tap
NC0815-inch = thread pitch { $pitch } mm: no standard thread has it
    .label = the nearest is { $nearest } mm ({ $threads } threads per inch){ $more ->
        [0] {""}
        [one] ; one more hole too
       *[other] ; { $more } more holes too
    }
    .help = feed = speed × pitch: compare F and S with the tap
