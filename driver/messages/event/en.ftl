# Events of a program that was executed, and the state of the machine at them.
event-differ = the source makes { $source }; the output makes { $output }
event-nothing = nothing more
event-to = { $event } to { $end } (machine coordinates of a test set-up)
event-rate = { $event } at F{ $rate }

event-rapid = a rapid move
event-feed = a feed move
event-probe = a probing move { $contact ->
        [away] off a contact
       *[into] into a contact
    } on the path to { $end }{ $error ->
        [yes] , or an error
       *[no] {""}
    }
event-arc = { $turn ->
        [clockwise] a clockwise
       *[counter-clockwise] a counter-clockwise
    } { $shape ->
        [circle] circle
       *[arc] arc
    } about { $centre }
event-thread = a thread of pitch { $pitch } mm
event-thread-chuck = a thread of pitch { $pitch } mm in a floating chuck
event-orient = an oriented spindle stop at { $angle }°
event-tilt = a tilted plane at { $origin } with Z along { $z } and X along { $x }
event-tilt-end = the end of the tilted plane
event-tool-axis = the tool swivelled to the plane
event-tool-axis-minus = the tool swivelled to the plane, minus
event-tool-axis-plus = the tool swivelled to the plane, plus
event-dwell = a dwell of { $seconds } s
event-tool-change = a change to tool { $tool }
event-function = the machine function { $name }
event-coolant = a switch of the coolant
event-stop = a program stop
event-optional-stop = an optional stop
event-end = the program end
event-begin-again = the program that begins again
event-text-end = the end of the text
event-attribute = a change of the state
event-message = the message { $text }
event-alarm = the alarm { $text }
event-alarm-number = the alarm { $number } { $text }
event-opened = output is opened
event-line = output of { $text }
event-closed = output is closed
event-offset = zero of work offset { $number } at { $zero }
event-offset-turned = zero of work offset { $number } at { $zero }, turned by { $angle }°
event-position = stored position { $number } at { $place }
event-tool = tool { $number } is in the spindle
event-length = length { $value } in entry { $entry }
event-value = { $kind } { $value } in entry { $entry }
event-value-added = { $kind } { $value } added to entry { $entry }
event-kind-length = length
event-kind-length-wear = length wear
event-kind-radius = radius
event-kind-radius-wear = radius wear
event-kind-x = offset along X
event-kind-y = offset along Y

# The state at an event: facts, one after the other.
event-with-tool = tool { $tool }
event-spindle-stopped = spindle stopped
event-spindle-clockwise = spindle clockwise at { $speed }
event-spindle-counter-clockwise = spindle counter-clockwise at { $speed }
event-speed-turns = { $speed } rev/min
event-speed-surface = { $speed } m/min about X{ $centre } (machine coordinates of a test set-up)
event-speed-limit = at most { $limit } rev/min
event-coolant-off = no coolant
event-flood = flood
event-mist = mist
event-flood-and-mist = flood and mist
event-compensation = compensation { $compensation }
event-tip = tool centre point control
event-tilted = a tilted plane
event-rotary-other-way = a rotary axis in the other direction
event-from-one-side = { $axis } from one side only

# Cutter compensation: which side, plane and radius.
event-compensation-off = off
event-compensation-entry = { $side } in { $plane } by entry { $entry }
event-compensation-diameter = { $side } in { $plane } by diameter { $diameter }
event-compensation-edge = { $side } in { $plane } by an edge of the tool
event-compensation-again = { $compensation }, switched on again
event-compensation-contour-feed = { $compensation }, F along the contour

# Events in one line, beside the block that makes them.
event-line-orient = spindle stopped at { $angle }°
event-line-text-end = end of the text
