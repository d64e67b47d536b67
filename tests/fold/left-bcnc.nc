# bCNC's drill command with pecks: left as it is.
# Seen in bCNC's issue 523. Characteristic: after every peck out to the travel height and a dwell there,
# then all the way down again at feed, through the air. A cycle goes back into the hole by rapid.
%
O1010
G21 G90 G17
G00 X0. Y0. Z3.
M03 S8000
G00 X10. Y10.
G01 Z-1. F50.
G00 Z3.
G04 P3000
G01 Z-2. F50.
G00 Z3.
G04 P3000
G01 Z-2.7 F50.
G00 Z3.
G04 P3000
G00 X20. Y10.
G01 Z-1. F50.
G00 Z3.
G04 P3000
G01 Z-2. F50.
G00 Z3.
G04 P3000
G01 Z-2.7 F50.
G00 Z3.
G04 P3000
M05
M30
%
---
ncc-ir 1
program 1010
assumed(feed-mode per-minute, work-offset 1, length-offset 0, no-origin-shift true)
USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute)
said STRAIGHT_TRAVERSE(X 0.mm, Y 0.mm, Z 3.mm)
SET_SPINDLE_SPEED(8000) & START_SPINDLE_CLOCKWISE()
said STRAIGHT_TRAVERSE(X 10.mm, Y 10.mm)
SET_FEED_RATE(50.mm) & said STRAIGHT_FEED(Z -1.mm)
said STRAIGHT_TRAVERSE(Z 3.mm)
DWELL(3.000s)
SET_FEED_RATE(50.mm) & said STRAIGHT_FEED(Z -2.mm)
said STRAIGHT_TRAVERSE(Z 3.mm)
DWELL(3.000s)
SET_FEED_RATE(50.mm) & said STRAIGHT_FEED(Z -2.7mm)
said STRAIGHT_TRAVERSE(Z 3.mm)
DWELL(3.000s)
said STRAIGHT_TRAVERSE(X 20.mm, Y 10.mm)
SET_FEED_RATE(50.mm) & said STRAIGHT_FEED(Z -1.mm)
said STRAIGHT_TRAVERSE(Z 3.mm)
DWELL(3.000s)
SET_FEED_RATE(50.mm) & said STRAIGHT_FEED(Z -2.mm)
said STRAIGHT_TRAVERSE(Z 3.mm)
DWELL(3.000s)
SET_FEED_RATE(50.mm) & said STRAIGHT_FEED(Z -2.7mm)
said STRAIGHT_TRAVERSE(Z 3.mm)
DWELL(3.000s)
STOP_SPINDLE_TURNING()
PROGRAM_END()
