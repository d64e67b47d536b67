# Generators of pecks for GRBL, which has no cycles (GRBL_Post, drill_translate of FreeCAD for G83).
# Seen in FreeCAD's drill_translate and in GRBL_Post (public Python sources). Characteristic: a first
# stroke from the retract plane, then out to it and back by rapid to just above the last bottom, the
# last stroke is what remains; between holes at the initial plane.
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
G00 Z-2.5
G01 Z-8. F120.
G00 Z2.
G00 Z-7.5
G01 Z-11. F120.
G00 Z10.
G00 X40. Y20.
G00 Z2.
G01 Z-3. F120.
G00 Z2.
G00 Z-2.5
G01 Z-8. F120.
G00 Z2.
G00 Z-7.5
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
START_CYCLE(drill-peck(peck 5.mm, clearance 0.5mm), XY, retract 2.mm, depth -11.mm, return initial, plane-first, feed 120.mm)
HOLE(X 10.mm, Y 20.mm)
HOLE(X 40.mm)
END_CYCLE()
STOP_SPINDLE_TURNING()
PROGRAM_END()
