# FreeCAD (Path, CAM), drilling cycles translated by the GRBL post processor.
# Seen in the FreeCAD issue 13106 (output of the post for G82). Characteristic: the cycle itself as a
# remark before its moves, the position twice (the second time it goes nowhere), F on the rapid
# down and again on the cut, dwell at the bottom, the way out only to the retract plane, F of
# the rapids on the move to the next hole.
%
O1003
G21 G90 G17
G00 X0. Y0. Z30.
M03 S2000
G00 Z10.
G00 X10. Y-1. F2000.
(G82 X10.000 Y-1.000 Z-6.000 F100.000 R2.000 P0.5)
G00 X10. Y-1.
G00 Z2. F100.
G01 Z-6. F100.
G04 P500
G00 Z2.
G00 X24. Y10. F2000.
(G82 X24.000 Y10.000 Z-6.000 F100.000 R2.000 P0.5)
G00 X24. Y10.
G00 Z2. F100.
G01 Z-6. F100.
G04 P500
G00 Z2.
G00 X38. Y21. F2000.
(G82 X38.000 Y21.000 Z-6.000 F100.000 R2.000 P0.5)
G00 X38. Y21.
G00 Z2. F100.
G01 Z-6. F100.
G04 P500
G00 Z2.
G00 Z10.
M05
M30
%
---
ncc-ir 1
program 1003
assumed(feed-mode per-minute, work-offset 1, length-offset 0, no-origin-shift true)
USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute)
said STRAIGHT_TRAVERSE(X 0.mm, Y 0.mm, Z 30.mm)
SET_SPINDLE_SPEED(2000) & START_SPINDLE_CLOCKWISE()
said STRAIGHT_TRAVERSE(Z 10.mm)
COMMENT("G82 X10.000 Y-1.000 Z-6.000 F100.000 R2.000 P0.5")
START_CYCLE(drill-dwell(dwell 0.5s), XY, retract 2.mm, depth -6.mm, return retract, plane-first, feed 100.mm)
HOLE(X 10.mm, Y -1.mm)
COMMENT("G82 X24.000 Y10.000 Z-6.000 F100.000 R2.000 P0.5")
HOLE(X 24.mm, Y 10.mm)
COMMENT("G82 X38.000 Y21.000 Z-6.000 F100.000 R2.000 P0.5")
HOLE(X 38.mm, Y 21.mm)
END_CYCLE()
said STRAIGHT_TRAVERSE(Z 10.mm)
STOP_SPINDLE_TURNING()
PROGRAM_END()
