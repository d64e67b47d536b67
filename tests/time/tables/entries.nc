(machine: fanuc.toml)
(The second Z goes nowhere. From -400 to -400 + 100 + 10, then to -400 + 150.5 + 10, and with none to -390.)
(seconds: 5 1.1 0.505 1.505)
O1
G21 G17 G90 G94 G54
T1 M06
G0 G43 H1 Z10.
Z10.
G43 H2 Z10.
G49 Z10.
M30
