NC0214 = the radius is too small for this arc
    .label = less than half the distance from start to end
    .help = check the radius, the end point and the start point
    .help-decimal-point = or is `{ $word }`, read as { $value }, meant in whole units? Then add `{ $option }`
