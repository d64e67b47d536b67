common-also-line = also in line { $last }
common-also-lines = also in lines { $lines } and { $last }
common-also-more = also in lines { $lines } and { $more } more { $more ->
        [one] place
       *[other] places
    }
common-also-places = also at { $more } more { $more ->
        [one] place
       *[other] places
    }
common-related = belongs to it
common-allow = to accept this loss, add `--allow { $verdict }`
common-deny = stopped because of `--deny { $verdict }`
common-explain = `ncc explain { $code }` says more

# Questions, and what each answer makes of the program.
common-question-label = both answers differ here first
common-answer-points = write decimal points
common-readings-taken = not stated, and it changes the cut; ncc took { $readings }
common-path-of-part = over { $words } of the part
common-path-from-here = from the present position
common-path-by-words = by { $words } from the present position
common-result-turn = { $axis } turns by { $by } degrees
common-result-drills = { $cycle } drills
common-result-moves = { $motion } moves all axes and cancels { $cycle }
common-result-end = { $axis } ends at { $at } mm
common-result-angle = { $axis } ends at { $at } degrees
common-result-centre = the centre is at { $axis } { $at } mm
common-result-feed-per-minute = the feed is { $rate } mm/min
common-result-feed-per-revolution = the feed is { $rate } mm/rev
common-result-inverse-time-feed = the feed is { $rate } moves a minute
common-result-dwell = the dwell is { $time } s
common-result-spindle-on = the spindle turns
common-result-spindle-off = the spindle is stopped
common-result-tool = tool { $number } cuts
common-result-refused = refused, { $code }
