NC0401 = comment rewritten
    .label = in the characters that { $target } can show
    .account = comments, in the characters of { $target }
