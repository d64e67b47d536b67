NC0426 = { $behaviour }, written as words
    .label = { $source } does it by itself here
    .account = { $behaviour }, as words
NC0426-feed = { $behaviour }, written as a code
    .label = { $source } and { $target } start with another meaning of F
    .account = { $behaviour }, as words
