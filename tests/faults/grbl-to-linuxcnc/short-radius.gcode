; the radius must reach half the chord to the last bit
G21 G90 G17 G94 G54
S9000 M3
G0 X0 Y0 Z5
G1 Z-1 F200
G2 X14.142 Y14.142 R10
G2 X0 Y0 R9.999
G0 Z5
M5
M30
