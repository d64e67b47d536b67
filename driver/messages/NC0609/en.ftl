NC0609 = partly verified: the output has more branches than the source
    .label = branches that did not run both ways: { $blocks }
    .help = check the output of these branches
