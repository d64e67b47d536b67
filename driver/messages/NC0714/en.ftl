NC0714 = there is no machine `{ $name }`
    .label = neither a shipped machine nor a file
    .help = name the file of a profile, or one of { $has }
NC0714-dialect = there is no machine `{ $name }`
    .label = { $name } is a dialect
    .help = write `{ $table }`
