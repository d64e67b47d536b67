NC0310 = edge 1 of tool { $tool } assumed to be length entry { $tool }
    .label = one control has lengths by edge, the other by entry
    .help = set length entry { $tool } to the length of edge 1 of the tool
