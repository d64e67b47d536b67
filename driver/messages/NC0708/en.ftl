NC0708 = this is not a value of { $key }
    .label = it takes { $takes }
