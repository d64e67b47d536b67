; the operator sets Z anew for the second tool: before the first Z it is nobody's number
G21 G90 G94 G17 G54
G0 X0 Y0
G0 Z5
S3000 M3
G1 Z-1.5 F200
X40 F700
M5 M9 G53 G0 Z0 T2 M0
S6000 M3
G0 X20 Y12
G0 Z5
G1 Z-1 F100
G0 Z5
M5
M30
