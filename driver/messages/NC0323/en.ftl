NC0323 = check at the machine: { $behaviour }
    .label = another cut where { $option } = { $other } on { $control }
    .help = state what your machine does: `--{ $side }-option { $option }={ $taken }` or `={ $other }`
NC0323-position = check at the machine: { $behaviour }
    .label = next run moves where { $option } = { $other } on { $control }
    .help = state what your machine does: `--{ $side }-option { $option }={ $taken }` or `={ $other }`
NC0323-values = check at the machine: { $behaviour }
    .label = next run differs where { $option } = { $other } on { $control }
    .help = state what your machine does: `--{ $side }-option { $option }={ $taken }` or `={ $other }`
