NC0240 = radius entry { $entry } is not known
    .label = ncc cannot compute the tool centre path
    .help = state the tool diameter in the profile of the source machine, or the radius in the program
NC0240-edge = the radius of this tool edge is not known
    .label = ncc cannot compute the tool centre path
    .help = state the tool diameter in the profile of the source machine, or the radius in the program
