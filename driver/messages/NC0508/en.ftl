NC0508 = { $behaviour }: { $target } does more here than { $source }
    .label = the cut runs with what { $target } switched or moved
    .help-z = program Z after the tool change, before the cut starts
    .help-switch = program `M03` or `M04`, and `M08`, after this code in the source
