# Reaming and boring from an HSM kernel ("reaming", "boring" expanded): feed in, feed out faster, rapid
# to the clearance plane.
# Seen in the cycle types of Autodesk's posts that call expandCyclePoint for what a control lacks
# (cycle.retractFeedrate; public .cps sources). Characteristic: two feeds in every hole, in one dwell.
%
O1008
G21 G90 G17
G00 X0. Y0. Z30.
M03 S600
G00 X10. Y10.
G00 Z3.
G01 Z-20. F40.
G04 P200
G01 Z3. F120.
G00 Z30.
G00 X50. Y10.
G00 Z3.
G01 Z-20. F40.
G04 P200
G01 Z3. F120.
G00 Z30.
M05
M30
%
---
ncc-ir 1
program 1008
assumed(feed-mode per-minute, work-offset 1, length-offset 0, no-origin-shift true)
USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute)
said STRAIGHT_TRAVERSE(X 0.mm, Y 0.mm, Z 30.mm)
SET_SPINDLE_SPEED(600) & START_SPINDLE_CLOCKWISE()
START_CYCLE(bore(dwell 0.2s, feed-out 120.mm), XY, retract 3.mm, depth -20.mm, return initial, plane-first, feed 40.mm)
HOLE(X 10.mm, Y 10.mm)
HOLE(X 50.mm)
END_CYCLE()
STOP_SPINDLE_TURNING()
PROGRAM_END()
