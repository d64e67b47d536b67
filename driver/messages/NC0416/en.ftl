NC0416 = { $before } is called { $name }
    .label = { $target } does not take the name
    .account = the name { $before }, as { $name }
