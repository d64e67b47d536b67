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

# What `ncc time` took for granted.
common-time-start = the tool starts at program zero in { $axes }
common-time-skip-off = block-skip { $count ->
        [one] switch { $levels } is off
       *[other] switches { $levels } are off
    }
common-time-stops = stops for the operator take no time
common-time-tilt = turning the tool axis onto tilted planes takes no time
common-time-tip = with tool centre point control, only the linear axes are timed
common-time-contours = compensated contours are timed as programmed, not along the tool centre
common-time-as-programmed = from line { $line } on, contours are timed as programmed
common-time-as-programmed-why = from line { $line } on, contours are timed as programmed: { $why }
common-time-radius = compensated contours are timed as programmed: no radius is stated for { $entries }
common-time-edge-radius = compensated contours are timed as programmed: no radius is stated for a tool edge
common-time-outer-corners = outer corners of compensated contours are arcs
common-time-offset-zero = { $offset } is machine zero
common-time-offsets-zero = all work offsets are machine zero
common-time-offsets-equal = all work offsets are equal
common-time-offset-axes = { $offset } = 0 in { $axes }
common-time-lengths-equal = all tools have the same length
common-time-length = length of tool { $tool } = 0 mm
common-time-length-edge = length of edge { $edge } of tool { $tool } = 0 mm
common-time-length-edge-at-start = length of edge { $edge } of the first tool = 0 mm
common-time-typical = rates, accelerations and times are typical figures, not those of one machine
common-time-marked = marked as assumed in the machine profile: { $facts }
common-time-path-tolerance = path tolerance where the program states none: { $tolerance } mm
common-time-bound = for the upper bound, { $fact }
common-time-whole-path = the whole path

# What `ncc check` did not check, and why.
common-unchecked-travel = travel of { $axis }
common-unchecked-ranges = travel, feed and speed ranges
common-unchecked-rapids = rapid moves
common-unchecked-feeds = feeds
common-unchecked-speeds = speeds
common-unchecked-rest = the rest of the program
common-unchecked-modes = rules that need the active modes, after that block
common-unchecked-no-machine = no machine is named (`--machine`)
common-unchecked-no-plane = no plane is named (`--rapid-plane`)
common-unchecked-not-stated = the profile does not state it
common-unchecked-no-offset = the profile does not state the zero of work offset { $offset }
common-unchecked-tool-unknown = ncc does not know which tool is in the spindle
common-unchecked-no-length = the profile does not state the length of tool { $tool }
common-unchecked-frame = the zero is not known after blocks that ncc could not read
common-unchecked-start = the start position is not stated
common-unchecked-tilted = tool centre point control or a tilted plane: ncc does not compute the axes
common-unchecked-no-feed = the profile states no highest feed
common-unchecked-no-speed = the profile states no highest speed
common-unchecked-endless = the program does not end
common-unchecked-not-read = ncc cannot read some blocks as { $dialect }, the first in line { $line }
