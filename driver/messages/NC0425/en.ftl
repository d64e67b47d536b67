NC0425 = the macro { $name } is written as { $names }
    .label = its calls pass different arguments
