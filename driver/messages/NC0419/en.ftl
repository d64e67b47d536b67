NC0419 = work offset { $offset } left out
    .label = { $target } does not have it; no move uses it
    .account = work offset { $offset } left out: no move uses it
