NC0332 = check at the machine: feed on arcs under cutter compensation
    .label = F is of the tool centre on { $source }, of the contour on { $target }
    .help-outer = check F on outer arcs: the contour is cut faster there, and slower on inner arcs
    .help-inner = check F on inner arcs: the contour is cut slower there
NC0332-contour = check at the machine: feed on arcs under cutter compensation
    .label = F is of the contour on { $source }, of the tool centre on { $target }
    .help = check F on inner arcs: the contour is cut faster there, and slower on outer arcs
