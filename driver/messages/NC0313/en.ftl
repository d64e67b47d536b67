NC0313 = radius entry { $entry } assumed for tool or length { $entry }
    .label = one control has radius entries, the other tool radii
    .help = set radius entry { $entry } to the radius of the tool
