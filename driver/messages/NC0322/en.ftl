NC0322 = { $behaviour }: started again before this cut
    .label = { $target } may have switched it off, { $source } has not
    .help = check at the machine that it runs before the tool touches the part
