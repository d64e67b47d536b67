NC0101 = unexpected character { $found }
    .label = no word in { $source } starts with it
    .help = is this program really { $source }? `--from auto` recognises the control from the text
    .help-bracket = a comment ends at its first closing sign: remove the inner brackets
    .help-line-ends = the lines end with CR alone: convert them with `tr '\r' '\n' < FILE > NEW`
