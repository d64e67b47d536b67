# The tables of `ncc dialects show`.
dialect-base = builds on: { $base }
dialect-extension = usual extension: .{ $extension }
dialect-rows = { $rows } rows, { $unsure } of them unconfirmed (marked ?)
dialect-number-value = a number, { $default }
dialect-default-value = { $value } (default)
dialect-source = source: { $source }

dialect-behaviours = What codes do besides their names (? is open: an option of the same name states it)
dialect-options = Options (--from-option, --to-option NAME=VALUE)
dialect-capabilities = What it can do
dialect-codes = Codes (word, meaning, source)
dialect-refused-codes = Codes that are known and refused
dialect-names = Words of several letters (word, meaning, source)
dialect-refused-names = Words of several letters that are known and refused
dialect-calls = Cycles and patterns that are called (name, meaning, arguments, source)
dialect-functions = Functions that programs of the user process (code, program, time limit)
dialect-function = { $program }, at most { $seconds } s
dialect-addresses = Words (letter, what it is, source)
dialect-variant = With { $options } (word, meaning or refusal, source)
dialect-power-on = At power-on (* always; else assumed, and reported)
dialect-sources = Sources

# Capabilities, each with its value.
dialect-yes = yes
dialect-no = no
dialect-everything = everything
dialect-everything-value = whatever the neutral program can hold
dialect-form = form
dialect-form-flat = a list of events; cycles, patterns, calls and repeats are expanded
dialect-cycles = cycles
dialect-return = cycles return to
dialect-return-stated = a stated plane
dialect-return-either = the initial level or the R plane
dialect-return-initial = the initial level
dialect-return-retract = the R plane
dialect-patterns = patterns of holes
dialect-bolt-circle = bolt circle
dialect-grid = grid
dialect-subprograms = subprograms
dialect-repeats = repetition of blocks
dialect-frames = frames
dialect-machine = machine coordinates
dialect-work-offsets = work offsets
dialect-one-offset = one, without a word for it
dialect-any-offset = any number
dialect-incremental = incremental coordinates
dialect-helices = helices
dialect-radius = arcs by radius
dialect-skip = block skip
dialect-one-switch = one switch
dialect-switches = { $number } switches
dialect-operator = messages to the operator

# Facts at power-on.
dialect-units = unit of length
dialect-distance = distance mode
dialect-plane = plane
dialect-feed-mode = feed mode
dialect-return-level = return level
dialect-motion = motion
dialect-work-offset = work offset
dialect-length-offset = length offset
dialect-no-shift = no origin shift
dialect-corners = corners

# What the option of an open behaviour states.
dialect-behaviour-option = What becomes of the { $about }. `unknown`: ncc runs the program with each value, the usual one (`{ $usual }`) first, and reports where they differ.
dialect-behaviour-option-variant = What becomes of the { $about }. `unknown`: ncc runs the program with each value, the usual one (`{ $usual }`) first, and reports where they differ. It counts with { $when }.
