# Values in words, as other messages show them.
spelled-end-of-line = the end of line
spelled-end-of-text = the end of text
spelled-line = a line
spelled-many-words = too many words
spelled-radii = radius { $start } mm at the start, { $end } mm at the end
spelled-next-run-values = the next run reads other values
spelled-next-run-place = the next run begins in another place
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
