# pcb-gcode, a user language program of Eagle, with its Mach profile.
# Seen in public .nc files of pcb-gcode 3.6. Characteristic: G00 or G01 in every block, F in every
# cut, blanks after each word, the tool travels at the height from which it cuts, out by rapid.
%
O1005
G21 G90 G17
G00 X0. Y0. Z12.7
M03 S15000
G00 Z1.
G00 X12.7 Y3.81
G01 Z-2.5 F64.
G00 Z1.
G00 X15.24 Y3.81
G01 Z-2.5 F64.
G00 Z1.
G00 X17.78 Y3.81
G01 Z-2.5 F64.
G00 Z1.
G00 Z12.7
M05
M30
%
---
ncc-ir 1
program 1005
assumed(feed-mode per-minute, work-offset 1, length-offset 0, no-origin-shift true)
USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute)
said STRAIGHT_TRAVERSE(X 0.mm, Y 0.mm, Z 12.7mm)
SET_SPINDLE_SPEED(15000) & START_SPINDLE_CLOCKWISE()
said STRAIGHT_TRAVERSE(Z 1.mm)
START_CYCLE(drill, XY, retract 1.mm, depth -2.5mm, return retract, plane-first, feed 64.mm)
LINE_PATTERN(start (12.7mm, 3.81mm), angle 0.deg, offset 0.mm, pitch 2.54mm, count 3)
END_CYCLE()
said STRAIGHT_TRAVERSE(Z 12.7mm)
STOP_SPINDLE_TURNING()
PROGRAM_END()
