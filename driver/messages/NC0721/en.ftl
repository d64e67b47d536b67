NC0721 = `{ $text }` is no body
    .label = neither a block, nor a cylinder along Z, nor a file of triangles
    .help = a block is X0:100 Y0:60 Z-20:0, a cylinder D50 X0 Y0 Z-30:0, a file ends with .stl
NC0721-range = `{ $text }` is no body
    .label = a range is empty or upside down, or the diameter is not above 0
    .help = the lower number first: X0:100 Y0:60 Z-20:0
