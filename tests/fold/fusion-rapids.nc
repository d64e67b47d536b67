# Autodesk Fusion 360 (HSM), cycles expanded by the post processor's kernel for a control without them.
# Seen in output of OpenBuilds' Fusion 360 post for GRBL (OpenbuildsFusion360PostGrbl.cps V1.0.27),
# public .gcode files. Characteristic: two rapids down before the first hole (clearance, then the
# feed height), the cut repeats X and Y though only Z moves and carries F in every hole, the way out
# is to the feed height alone, rapids between holes are modal without G0.
%
O1001
G21 G90 G17
G00 X63. Y318. Z40.
S10000 M03
Z15.
Z5.
G01 X63. Y318. Z-1. F333.
G00 Z5.
X95. Y350.
G01 X95. Y350. Z-1. F333.
G00 Z5.
X407.5 Y394.25
G01 X407.5 Y394.25 Z-1. F333.
G00 Z5.
Z15.
M05
M30
%
---
ncc-ir 1
program 1001
assumed(feed-mode per-minute, work-offset 1, length-offset 0, no-origin-shift true)
USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute)
said STRAIGHT_TRAVERSE(X 63.mm, Y 318.mm, Z 40.mm)
SET_SPINDLE_SPEED(10000) & START_SPINDLE_CLOCKWISE()
STRAIGHT_TRAVERSE(Z 15.mm)
START_CYCLE(drill, XY, retract 5.mm, depth -1.mm, return retract, plane-first, feed 333.mm)
POSITION_LIST((X 63.mm, Y 318.mm), (X 95.mm, Y 350.mm), (X 407.5mm, Y 394.25mm))
END_CYCLE()
STRAIGHT_TRAVERSE(Z 15.mm)
STOP_SPINDLE_TURNING()
PROGRAM_END()
