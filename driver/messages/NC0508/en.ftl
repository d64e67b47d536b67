NC0508 = { $behaviour }: { $target } does more here than { $source }
    .label = the next cut needs what { $target } switches or moves
    .help-z = program Z after the tool change, before the cut starts
    .help-switch = program `M03` or `M04`, and `M08`, after this code in the source
