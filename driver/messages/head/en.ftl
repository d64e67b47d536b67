# The comment that opens a program: who wrote it, of what, and what it relies on.
head-verified = ncc: { $dialect } { $name } sha256 { $hash }, verified
head-unverified = ncc: { $dialect } { $name } sha256 { $hash }, UNVERIFIED
head-called = called: { $name } sha256 { $hash }
head-not-answered = not answered: { $facts }
head-assumed = assumed: { $facts }
head-tool-numbers = tools by name: { $pairs }
head-length-entry-numbers = length entries by name: { $pairs }
head-work-offset-numbers = work offsets by name: { $pairs }
head-program-numbers = programs by name: { $pairs }

# What was assumed, each in a few words.
head-motion = motion = { $value }
head-distance = start in { $value } mode
head-units = units = { $value }
head-plane = plane = { $value }
head-feed-mode = feed { $value }
head-return-level = cycles return to { $value }
head-work-offset = work offset = { $value }
head-no-length-offset = no length offset at the start
head-no-origin-shift = no origin shift at the start
head-no-effect = { $code } has no effect
head-function = { $code } by a program of the user
head-bare-number = { $word } without point = { $value }
head-offset-with-z = tool length offset takes effect at the next Z move
head-only-work-offset = the only work offset = { $value }
head-fact = { $name } = { $value }
head-hole-order = order of the holes of { $pattern }
head-corners = corners always by { $path }
head-milling = a milling program, though line { $line } looks like { $looks-like }
head-tip = rotary axes, and the zero of the tool tip, as on the other control
head-tool-change = tool_with_change = named
head-call-depth = calls go { $depth } deep, older controls take { $sure }
head-macro-call-depth = macro calls go { $depth } deep, older controls take { $sure }
head-cycle = cycle_beside_motion = drilled
head-return = return_distance = last
head-control = control = { $taken }, not { $other }
head-tilt = the tool swivelled to tilted planes as on the other control
head-contour-path = tool centre path computed as by RS274/NGC
head-started-again = { $behaviour }: started again before the next cut
head-behaviour = { $option } = { $taken } on { $control }
head-optional-stop = the switch for optional stops is off
head-path-at-start = no path mode is programmed: corners { $source-path } on { $source }, { $target-path } on { $target }
head-next-run-shifted = no shift of { $axis } at the start, though the program leaves one
head-next-run-turned = no rotation, scale or mirror at the start, though the program leaves one
head-next-run-variables = { $variables } kept { $source-kept } on { $source }, { $target-kept } on { $target }
head-rounds-freely = corners rounded without a tolerance
head-feed-on-contour = F on arcs under cutter compensation: along the contour on { $source }, at the tool centre on { $target }
head-feed-on-centre = F on arcs under cutter compensation: at the tool centre on { $source }, along the contour on { $target }
head-length-by-hand = the zero of Z is set by tool { $tool } when it is put in
head-moved-at-change = a tool change takes Z to machine zero
head-contour-ends = the same lead-in and lead-out of a compensated contour
head-radius = a radius entry = the radius of the tool of its number
head-edge = edge 1 of a tool = the length entry of its number
head-edge-number = edge { $edge } of tool { $tool } = length entry { $entry }
