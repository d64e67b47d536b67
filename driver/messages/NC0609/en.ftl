NC0609 = partly verified: the output has more branches than the source
    .label = branches with an uncovered side: { $blocks }
    .help = check the output of these branches
