NC0422 = alarms have other numbers
    .label = in { $target }, { $map }
    .account = alarms under other numbers
