# The account of `ncc simulate`.
simulate-of = { $program } ({ $dialect }): { $alarms ->
        [0] no alarm
        [one] one alarm
       *[other] { $alarms } alarms
    }
simulate-raw = raw part
simulate-removed = removed
simulate-under = undercut
simulate-under-volume = { $volume } mm³ taken under what stays: a picture from above does not show it
simulate-planes = planes
simulate-planes-tilted = an upright tool moves on { $planes ->
        [one] a tilted plane
       *[other] { $planes } tilted planes
    }
simulate-time = time
simulate-cells = cells
simulate-block = X{ $x0 } to { $x1 }, Y{ $y0 } to { $y1 }, Z{ $z0 } to { $z1 }
simulate-cylinder = diameter { $d } at X{ $x } Y{ $y }, Z{ $z0 } to { $z1 }
simulate-body = triangles within X{ $x0 } to { $x1 }, Y{ $y0 } to { $y1 }, Z{ $z0 } to { $z1 }
simulate-guessed-raw = { $raw } (guessed from the cuts: `--stock` states it)
simulate-stated-raw = { $raw }
simulate-of-raw = { $volume } mm³ of { $all } mm³
simulate-tool = T{ $number }
simulate-start-tool = the tool at the start
simulate-named-tool = a tool with a name
simulate-worked = { $volume } mm³ in { $time }; { $shape }, { $diameter } mm ({ $known })
simulate-stated = stated
simulate-profile = from the profile
simulate-comment = from the comment in line { $line }
simulate-guess = guessed
simulate-shape-guessed = { $known }, shape guessed
simulate-grid = { $columns } × { $rows }, { $cell } mm each
simulate-rests-tool = this rests on a guessed tool: `--tool` or the profile states it
simulate-rests-raw = this rests on a guessed raw part: `--stock` states it
simulate-heights = the tool cuts nothing at the start and in machine coordinates, until it moves along Z: its height is not known there
simulate-straightened = a tilted plane without angles turns all rotary axes back to zero
simulate-after-planes = after a tilted plane is set or cancelled, the tool cuts nothing until X, Y and Z are stated: its position is not known there
simulate-contours = compensated contours are cut as programmed, without the radius: the profile states it
simulate-offsets = work offsets { $offsets } are at one point here: a profile with `[[work_offset]]` states them
simulate-between = between the parts
simulate-same = no height differs by more than { $tolerance } mm
simulate-differs = { $first } has { $more } mm³ more and { $less } mm³ less than { $second }
simulate-above = at most { $by } mm above it, at { $place }
simulate-below = at most { $by } mm below it, at { $place }
simulate-no-cut = { $program } cuts nothing: there is no raw part to guess
    .help = state one: `--stock "X0:100 Y0:60 Z-20:0"`
simulate-no-cutter = tool { $tool }: { $name } { $value } is not possible
    .help = state the tool: `--tool { $tool }=flat,10`
simulate-no-cutter-corner = tool { $tool }: corners of { $corner } mm on a radius of { $radius } mm
    .help = state the tool: `--tool { $tool }=bull-nose,10,corner=1`
simulate-no-cutter-neck = tool { $tool }: a neck of { $neck } mm on a diameter of { $diameter } mm
    .help = the neck (`shank`) is thinner than what cuts: `--tool { $tool }=t-slot,16,flute=5,shank=7`
simulate-undercut = tool { $tool } becomes thinner upwards: only a lollipop or a T-slot cutter may
    .help = simulate the program without it
simulate-shape-flat = flat
simulate-shape-ball = ball
simulate-shape-bull-nose = bull nose, corners { $corner } mm
simulate-shape-drill = drill, point { $angle }°
simulate-shape-chamfer = chamfer, { $angle }°
simulate-shape-taper = taper, { $angle }°
simulate-shape-profile = profile
simulate-shape-lollipop = lollipop
simulate-shape-t-slot = T-slot
simulate-coarse-name = coarse
simulate-coarse = cells are large for { $tools }, which may cut and touch between them: `--cells { $cells }`
simulate-untouched-name = untouched
simulate-untouched = no cut touches the raw part: check where it lies, and the work offset
simulate-no-tool = { $unused }: the program has no such tool
    .help = it has { $used }
