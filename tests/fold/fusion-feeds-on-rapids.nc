# Autodesk Fusion 360 through a post for machines whose rapids take a feed (MPCNC, Marlin family).
# Seen in output of MPCNC21.cps (Fusion CAM 2.0.18961), public .gcode files. Characteristic: an F
# on every rapid, one for X and Y and one for Z, which no cut uses; the clearance plane between holes,
# chips broken by a short rapid lift at each peck.
%
O1002
G21 G90 G17
G00 X0. Y0. Z30.
M03 S5000
G00 Z3. F300.
X77.5 Y49.5 F7500.
Z1. F300.
G01 Z-3. F1000.
G00 Z-2. F300.
G01 Z-6. F1000.
G00 Z-5. F300.
G01 Z-8.25 F1000.
G00 Z3. F300.
X49.5 Y77.5 F7500.
Z1. F300.
G01 Z-3. F1000.
G00 Z-2. F300.
G01 Z-6. F1000.
G00 Z-5. F300.
G01 Z-8.25 F1000.
G00 Z3. F300.
Y132.5 F7500.
M05
M30
%
---
ncc-ir 1
program 1002
assumed(feed-mode per-minute, work-offset 1, length-offset 0, no-origin-shift true)
USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute)
said STRAIGHT_TRAVERSE(X 0.mm, Y 0.mm, Z 30.mm)
SET_SPINDLE_SPEED(5000) & START_SPINDLE_CLOCKWISE()
SET_FEED_RATE(300.mm) & said STRAIGHT_TRAVERSE(Z 3.mm)
START_CYCLE(drill-break(peck 3.mm, lift 1.mm, first 4.mm), XY, retract 1.mm, depth -8.25mm, return initial, plane-first, feed 1000.mm)
HOLE(X 77.5mm, Y 49.5mm)
HOLE(X 49.5mm, Y 77.5mm)
END_CYCLE()
SET_FEED_RATE(7500.mm) & STRAIGHT_TRAVERSE(Y 132.5mm)
STOP_SPINDLE_TURNING()
PROGRAM_END()
