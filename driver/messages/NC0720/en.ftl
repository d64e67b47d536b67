NC0720 = no fact names the source `{ $tag }`
    .label = nearest: `{ $nearest }`, which is not in this list
    .related = named here
    .help = write the same name in both places
