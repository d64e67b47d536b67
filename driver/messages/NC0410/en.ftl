NC0410 = block written as several
    .label = this block
    .account = blocks, as several
