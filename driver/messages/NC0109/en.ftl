NC0109 = { $found } is not expected here
    .label = expected { $expected }
    .help-comment = a comment on { $source } starts with `{ $open }`
