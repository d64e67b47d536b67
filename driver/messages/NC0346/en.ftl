NC0346 = edge { $edge } of tool { $tool } is length entry { $entry }
    .label = numbered in the order of use: set this entry
