NC0421 = variables have other names
    .label = in { $target }, { $map }
    .account = variables under other names
