NC0509 = { $behaviour }: what does { $source } do here?
    .label = a parameter decides, and { $target } must know
    .help = state what the machine does: { $options }
