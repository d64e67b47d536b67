(blocks with the mark, and an optional stop)
G21 G17 G90 G94 G54
S2000 M3
G0 X0 Y0 Z10
/G0 X5
G99 G81 X10 Y5 Z-4 R2 F200
/X20
X30
G80
M1
/M0
G0 Z20
M5
M30
