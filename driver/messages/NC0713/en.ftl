NC0713-length-table = { $key }: the dialect has no length table
    .label = its tools have edges
NC0713-block-numbers = { $key }: the dialect has no block numbers
    .label = cannot be written
NC0713-comments = { $key }: the dialect has no comments
    .label = cannot be written
NC0713-program-numbers = { $key }: the dialect has no program numbers
    .label = cannot be written
