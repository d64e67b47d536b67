# Values in words, as other messages show them.
spelled-end-of-line = the end of line
spelled-end-of-text = the end of text
spelled-line = a line
spelled-many-words = too many words
spelled-radii = radius { $start } mm at the start, { $end } mm at the end
spelled-next-run-values = the next run reads other values
spelled-next-run-place = the next run starts at another position
spelled-radius-of-entry = the radius of entry { $entry } is not known
spelled-radius-of-edge = the radius of this edge is not known
spelled-kept-until-end = until the program ends
spelled-kept-until-off = until it is switched off
spelled-kept-always = for ever
spelled-variables = { $count ->
        [one] variable { $names }
       *[other] variables { $names }
    }
spelled-motion = motion mode
spelled-distance = distance mode
spelled-units = unit of length
spelled-plane = plane
spelled-feed-mode = feed mode
spelled-return-level = return level of cycles
spelled-work-offset = work offset
spelled-length-offset = length offset
spelled-origin-shift = origin shift
spelled-work-offset-number = work offset { $number }

# The text that was expected: in `expected …`.
spelled-end-of-block = the end of the block
spelled-one-of = one of { $names }
spelled-most-words = at most { $most } words in a line
spelled-most-bodies = at most { $most } bodies inside each other
spelled-word = a word
spelled-word-or-number = a word or a number
spelled-number = a number
spelled-number-or-nothing = a number, `_`
spelled-whole-number = a whole number
spelled-text = a text
spelled-plain-escapes = a text without other escapes
spelled-name = a name
spelled-path = a path
spelled-type = a type
spelled-jump = a jump
spelled-expression = an expression
spelled-statement = a statement
spelled-block = a block
spelled-operator-or-end = an operator or the end of the block
spelled-body-at-end = `{"{"}` at the end of the line
spelled-end-of-body = `{"}"}` first
spelled-end-of-body-alone = `{"}"}` alone
spelled-point-of-plane = a move to a point of the plane
spelled-rotary-axis = a rotary axis
spelled-straight-move = a straight move

# Values of modes.
spelled-motion-feed = line at feed

# How corners are taken at the start.
spelled-path-exact-stop = exact stop
    .short = exact stop
spelled-path-rounded = rounded by the lag of the axes
    .short = rounded
spelled-path-within = rounded within a setting
    .short = within a setting
spelled-path-blended = blended without a tolerance
    .short = blended

# Alarms, and the alarms of the target in their place.
spelled-alarm = { $from } is { $to }
spelled-alarm-cut = { $from } is { $to } with the text { $text }
spelled-alarm-text = { $text }

# The state of the machine beside a block.
spelled-feed-move = feed move
spelled-cycle = { $kind } from { $retract } to { $depth }
spelled-cycle-initial = { $kind } from { $retract } to { $depth }, back to the initial level
spelled-cycle-retract = { $kind } from { $retract } to { $depth }, back to the retract plane
