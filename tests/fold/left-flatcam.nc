# FlatCAM, holes of a circuit board: left as it is.
# Seen in Candle's issue 390 (output of FlatCAM 8.991). Characteristic: out at feed to the surface, then
# on by rapid to the height at which it travels. A canned cycle cuts from the plane to which it feeds
# out, so that none makes these moves.
%
O1009
G21 G90 G17
G00 X0. Y0. Z15.
M03 S400
G01 F60.
G00 X35.5 Y15.25
G00 Z2.
G01 Z-1.7
G01 Z0.
G00 Z2.
G00 X35.5 Y17.75
G01 Z-1.7
G01 Z0.
G00 Z2.
G00 X36.75 Y25.
G01 Z-1.7
G01 Z0.
G00 Z2.
M05
M30
%
---
ncc-ir 1
program 1009
assumed(feed-mode per-minute, work-offset 1, length-offset 0, no-origin-shift true)
USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute)
said STRAIGHT_TRAVERSE(X 0.mm, Y 0.mm, Z 15.mm)
SET_SPINDLE_SPEED(400) & START_SPINDLE_CLOCKWISE()
SET_FEED_RATE(60.mm)
said STRAIGHT_TRAVERSE(X 35.5mm, Y 15.25mm)
said STRAIGHT_TRAVERSE(Z 2.mm)
said STRAIGHT_FEED(Z -1.7mm)
said STRAIGHT_FEED(Z 0.mm)
said STRAIGHT_TRAVERSE(Z 2.mm)
said STRAIGHT_TRAVERSE(X 35.5mm, Y 17.75mm)
said STRAIGHT_FEED(Z -1.7mm)
said STRAIGHT_FEED(Z 0.mm)
said STRAIGHT_TRAVERSE(Z 2.mm)
said STRAIGHT_TRAVERSE(X 36.75mm, Y 25.mm)
said STRAIGHT_FEED(Z -1.7mm)
said STRAIGHT_FEED(Z 0.mm)
said STRAIGHT_TRAVERSE(Z 2.mm)
STOP_SPINDLE_TURNING()
PROGRAM_END()
