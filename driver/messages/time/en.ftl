# What `ncc time` took for granted.
time-start = the tool starts at program zero in { $axes }
time-skip-off = block-skip { $count ->
        [one] switch { $levels } is off
       *[other] switches { $levels } are off
    }
time-stops = stops for the operator take no time
time-tilt = turning the tool axis onto tilted planes takes no time
time-tip = with tool centre point control, only the linear axes are timed
time-contours = compensated contours are timed as programmed, not along the tool centre
time-as-programmed = from line { $line } on, contours are timed as programmed
time-as-programmed-why = from line { $line } on, contours are timed as programmed: { $why }
time-radius = compensated contours are timed as programmed: no radius is stated for { $entries }
time-edge-radius = compensated contours are timed as programmed: no radius is stated for a tool edge
time-outer-corners = outer corners of compensated contours are arcs
time-rapid-rate = { $code } has no effect: rapid moves at the rate of the machine
time-offset-zero = { $offset } is machine zero
time-offsets-zero = all work offsets are machine zero
time-offsets-equal = all work offsets are equal
time-offset-axes = { $offset } = 0 in { $axes }
time-lengths-equal = all tools have the same length
time-length = length of tool { $tool } = 0 mm
time-length-edge = length of edge { $edge } of tool { $tool } = 0 mm
time-length-edge-at-start = length of edge { $edge } of the first tool = 0 mm
time-typical = rates, accelerations and times are typical figures, not those of one machine
time-marked = marked as assumed in the machine profile: { $facts }
time-path-tolerance = path tolerance where the program states none: { $tolerance } mm
time-bound = for the upper bound, { $fact }
time-whole-path = the whole path

# What a model of time takes into account.
time-model-ideal = rates and fixed times, no acceleration
time-model-trapezoidal = rates and accelerations of the axes, look-ahead, no jerk
time-model-jerk-limited = rates, accelerations and jerk of the axes, look-ahead

# Facts that a model of time needs.
time-fact-rapid-rate = rapid rate
time-fact-acceleration = acceleration
time-fact-jerk = jerk
time-fact-path-tolerance = path tolerance
time-fact-exact-stop = exact stop after every move
time-fact-tool-change = time of a tool change
time-fact-spindle-start = time of a spindle start
time-fact-spindle-stop = time of a spindle stop
time-fact-m-function = time of an M function
time-fact-block = block processing time
time-fact-look-ahead = look-ahead
