# pcb2gcode 2.5, holes of a circuit board without canned cycles.
# Seen in public .nc files of pcb2gcode 2.5.0 and in its issue 57. Characteristic: the feed once
# for all holes of a tool, on a G1 without words; the tool travels at the height from which it cuts;
# in and out at feed, so that it is boring to a canned cycle; X and Y both named at every hole.
%
O1004
G21 G90 G17
G00 X0. Y0. Z5.
M03 S10000
G00 Z1.
G01 F25.
G00 X-13.605 Y44.615
G01 Z-1.8
G01 Z1.
G00 X-13.605 Y51.615
G01 Z-1.8
G01 Z1.
G00 X-2.25 Y60.
G01 Z-1.8
G01 Z1.
G00 Z5.
M05
M30
%
---
ncc-ir 1
program 1004
assumed(feed-mode per-minute, work-offset 1, length-offset 0, no-origin-shift true)
USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute)
said STRAIGHT_TRAVERSE(X 0.mm, Y 0.mm, Z 5.mm)
SET_SPINDLE_SPEED(10000) & START_SPINDLE_CLOCKWISE()
said STRAIGHT_TRAVERSE(Z 1.mm)
START_CYCLE(bore, XY, retract 1.mm, depth -1.8mm, return retract, plane-first, feed 25.mm)
POSITION_LIST((X -13.605mm, Y 44.615mm), (X -13.605mm, Y 51.615mm), (X -2.25mm, Y 60.mm))
END_CYCLE()
said STRAIGHT_TRAVERSE(Z 5.mm)
STOP_SPINDLE_TURNING()
PROGRAM_END()
