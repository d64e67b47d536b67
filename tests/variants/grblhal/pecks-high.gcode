(deep holes, left where the tool stood: each peck goes up there)
G21 G17 G90 G94 G54
S4000 M3
G0 X0 Y0 Z6
G98 G83 X12 Y8 Z-9 R1.5 Q4 F120
X24
G80
G0 Z30
M5
M30
