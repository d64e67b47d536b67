# FreeCAD (Path, CAM), pecks translated by its posts for firmware without cycles (Marlin, GRBL).
# Seen in drill_translate of FreeCAD's marlin_post.py (public source). Characteristic: F on every cut;
# after a peck out to the retract plane, and back by rapid to half a peck above the last bottom; the last
# peck is what remains; out to the initial plane at last (G98).
%
O1006
G21 G90 G17
G00 X0. Y0. Z30.
M03 S3000
G00 Z10.
G00 X10. Y20.
G00 Z2.
G01 Z-3. F120.
G00 Z2.
G00 Z-0.5
G01 Z-8. F120.
G00 Z2.
G00 Z-5.5
G01 Z-11. F120.
G00 Z10.
G00 X40. Y20.
G00 Z2.
G01 Z-3. F120.
G00 Z2.
G00 Z-0.5
G01 Z-8. F120.
G00 Z2.
G00 Z-5.5
G01 Z-11. F120.
G00 Z10.
M05
M30
%
---
ncc-ir 1
program 1006
assumed(feed-mode per-minute, work-offset 1, length-offset 0, no-origin-shift true)
USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute)
said STRAIGHT_TRAVERSE(X 0.mm, Y 0.mm, Z 30.mm)
SET_SPINDLE_SPEED(3000) & START_SPINDLE_CLOCKWISE()
said STRAIGHT_TRAVERSE(Z 10.mm)
START_CYCLE(drill-peck(peck 5.mm, clearance 2.5mm), XY, retract 2.mm, depth -11.mm, return initial, plane-first, feed 120.mm)
HOLE(X 10.mm, Y 20.mm)
HOLE(X 40.mm)
END_CYCLE()
STOP_SPINDLE_TURNING()
PROGRAM_END()
