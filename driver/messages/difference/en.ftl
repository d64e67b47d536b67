# What `ncc diff` and `ncc verify` found.

# On how much it is so, and of which tool.
difference-extent = { $moves ->
        [0] { $events ->
            [one] 1 event
           *[other] { $events } events
        }
        [one] 1 move
       *[other] { $moves } moves
    }
difference-things = { $holes ->
        [0] { difference-extent }
        [one] one hole
       *[other] { $holes } holes
    }
difference-replacement = { $new-holes ->
        [0] { $new-moves ->
            [0] { $new-events ->
                [one] 1 event
               *[other] { $new-events } events
            }
            [one] 1 move
           *[other] { $new-moves } moves
        }
        [one] one hole
       *[other] { $new-holes } holes
    }
difference-events = { $events ->
        [one] 1 event
       *[other] { $events } events
    }
difference-places = { $places ->
        [one] 1 difference
       *[other] { $places } differences
    }
difference-of-tool = { $tool ->
        [0] {""}
       *[other] {" "}of T{ $tool }
    }

# Each kind of difference: in full, and as one of many in several places.
difference-feed = feed { $before } → { $after } on { difference-extent }{ difference-of-tool }
    .many = another feed on { difference-events } ({ difference-places })
difference-speed = spindle speed { $before } → { $after } on { difference-extent }{ difference-of-tool }
    .many = another spindle speed on { difference-events } ({ difference-places })
difference-surface-speed = constant surface speed { $before } → { $after } m/min on { difference-extent }{ difference-of-tool }
difference-speed-limit = highest spindle speed { $before } → { $after } on { difference-extent }{ difference-of-tool }
    .many = another highest spindle speed on { difference-events } ({ difference-places })
difference-spindle = spindle { $before } → { $after } on { difference-extent }{ difference-of-tool }
    .many = another direction of the spindle on { difference-events } ({ difference-places })
difference-tool = tool { $before } → { $after } on { difference-extent }{ difference-of-tool }
    .many = another tool on { difference-events } ({ difference-places })
difference-coolant = coolant { $before } → { $after } on { difference-extent }{ difference-of-tool }
    .many = other coolant on { difference-events } ({ difference-places })
difference-compensation = cutter compensation { $before } → { $after } on { difference-extent }{ difference-of-tool }
    .many = other cutter compensation on { difference-events } ({ difference-places })
difference-work-offset = work offset { $before } → { $after } on { difference-extent }{ difference-of-tool }
    .many = another work offset on { difference-events } ({ difference-places })
difference-length = tool length offset { $before } → { $after } on { difference-extent }{ difference-of-tool }
    .many = another tool length offset on { difference-events } ({ difference-places })
difference-frame = same coordinates at another machine position on { difference-extent }{ difference-of-tool }
    .many = same coordinates at another machine position on { difference-events } ({ difference-places })
difference-moved = { difference-things }{ difference-of-tool } { $distance } off ({ $offset })
    .many = { difference-events } up to { $distance } off ({ difference-places })
difference-arc = { $events ->
        [one] an arc{ difference-of-tool } with another centre, direction or sweep
       *[other] { $events } arcs{ difference-of-tool } with another centre, direction or sweep
    }
    .many = arcs with another centre, direction or sweep on { difference-events } ({ difference-places })
difference-kind = another kind of move: { $before } → { $after }
    .many = another kind of move on { difference-events } ({ difference-places })
difference-orientation = angle of the spindle { $before } → { $after }
    .many = another angle of the spindle on { difference-events } ({ difference-places })
difference-dwell = dwell { $before } s → { $after } s
    .many = another dwell on { difference-events } ({ difference-places })
difference-text = another text or function
    .many = another text or function on { difference-events } ({ difference-places })
difference-shift = all that follows is shifted by { $offset }, over { difference-extent }
    .many = all that follows is shifted on { difference-events } ({ difference-places })
difference-gap-first = { difference-things }{ difference-of-tool } only in the first
difference-gap-second = { difference-things }{ difference-of-tool } only in the second
difference-gap-replaced = { difference-things }{ difference-of-tool } replaced by { difference-replacement }
difference-gap = { $events ->
        [one] 1 event
       *[other] { $events } events
    } only in the first and { $new-events } only in the second ({ difference-places })

# Values of both sides.
difference-first-tool = the one at the start
difference-turns = { $speed } rev/min
difference-surface = { $speed } m/min constant surface speed
difference-none = none
difference-move-rapid = rapid move
difference-move-feed = feed move
difference-move-thread = thread
difference-move-orient = oriented spindle stop
difference-move-arc = arc
difference-move-dwell = dwell
difference-move-tool-change = tool change
difference-move-function = machine function
difference-move-stop = program stop
difference-move-optional-stop = optional stop
difference-move-end = program end
difference-move-begin-again = program that begins again
difference-move-text-end = end of the text without a program end
difference-move-message = message
difference-move-alarm = alarm

# The summary: differences after each other, each with its place.
difference-same-cut = the same cut
difference-same-path = same path
difference-at = { $difference } at { $block }
difference-first-at = { $difference } first at { $block }
difference-several = { $difference } in { $places } places, first at { $block }
difference-several-unplaced = { $difference } in { $places } places
difference-left-out = and { difference-places } that are counted only
difference-block-number = N{ $number }
difference-block-line = line { $line }

# What the reader of a comparison must know.
difference-mute = messages are not compared: one of the controls has none
difference-mute-control = messages are not compared: { $dialect } has none
difference-units = one program is in inches, the other in millimetres
difference-sampled = too many block-skip switches: not all of their settings were tried
difference-lost = the programs are too long to be matched again after a part where they have nothing in common

# Why an output of ncc itself is not released.
difference-head = the head of the output is more than a comment
difference-no-call = the listing has a line that is no call of it: { $line }

# The page of `ncc diff --format html`.
difference-page-compared = Compared: { $same } events that agree, { $first } and { $second } that do not; in { $set-ups } test set-ups, under { $settings } setting(s) of the block-skip switches, within { $within } mm.
difference-page-left-out = … and { $more } more, too many to be listed.
