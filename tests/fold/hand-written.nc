# As programmers write it at a control, and posts that write only what changes ("modal" posts).
# Seen in the practice that the Mastercam reference describes for drill cycles that the post writes
# as discrete moves (Volume 1, chapter 15). Characteristic: block numbers, G0 and G1 only where they
# change, F only at the first cut, a word for an axis only if it moves, coolant between.
%
O1007
N10 G21 G90 G17
N20 G00 X20. Y15. Z50.
N30 S1200 M03
N40 Z25. M08
N50 Z2.
N60 G01 Z-12.5 F90.
N70 G00 Z25.
N80 X60.
N90 Z2.
N100 G01 Z-12.5
N110 G00 Z25.
N120 Y45.
N130 Z2.
N140 G01 Z-12.5
N150 G00 Z25.
N160 X20.
N170 Z2.
N180 G01 Z-12.5
N190 G00 Z25. M09
N200 M30
%
---
ncc-ir 1
program 1007
assumed(feed-mode per-minute, work-offset 1, length-offset 0, no-origin-shift true)
N10 USE_LENGTH_UNITS(mm) & SELECT_PLANE(XY) & SET_DISTANCE_MODE(absolute)
N20 said STRAIGHT_TRAVERSE(X 20.mm, Y 15.mm, Z 50.mm)
N30 SET_SPINDLE_SPEED(1200) & START_SPINDLE_CLOCKWISE()
N40 FLOOD_ON() & STRAIGHT_TRAVERSE(Z 25.mm)
N50 START_CYCLE(drill, XY, retract 2.mm, depth -12.5mm, return initial, plane-first, feed 90.mm)
RECTANGULAR_LAYOUT(columns (X, 40.mm, 2), rows (Y, 30.mm, 2), serpentine)
END_CYCLE() & COOLANT_OFF()
N200 PROGRAM_END()
