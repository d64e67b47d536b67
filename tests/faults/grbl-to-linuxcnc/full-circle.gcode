; a full circle needs a word of its end
G21 G90 G17 G94 G54
S9000 M3
G0 X0 Y0 Z5
G1 Z-1 F200
G2 I5
G2 X0 I5 K3
G0 Z5
M5
M30
