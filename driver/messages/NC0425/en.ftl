NC0425 = the macro { $name } is written as { $names }
    .label = its calls pass different arguments
    .account = the macro { $name }, as { $names }: one for each set of arguments
