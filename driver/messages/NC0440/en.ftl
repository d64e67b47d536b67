NC0440 = compensated contour written as the tool centre path
    .label = with the radius { $radius } mm
    .account = a compensated contour into the tool centre path, by { $radius } mm
