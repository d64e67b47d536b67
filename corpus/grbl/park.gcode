; through the point above the part to the stored one
G21
G90
G17
G0 X5 Y5 Z10
M3 S5000
G1 Z-0.5 F100
X45
G0 Z10
M5 M9
G28 G91 Z0
G90
G28 G91 X0 Y0
G90
M30
