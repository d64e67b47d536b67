(a length in the block of its move)
G21 G17 G90 G94 G54
T3 M6
S2000 M3
G0 G43 H3 Z10
X5 Y5
G1 Z-2 F60
X15
G0 Z40
M5
M30
