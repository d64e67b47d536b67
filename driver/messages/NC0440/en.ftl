NC0440 = compensated contour written as the tool centre path
    .label = with the radius { $radius } mm
