NC0243 = { $code } is processed by a program of yours: not started
    .label = ncc starts `{ $program }` only if you agree
    .help = if you trust it, start it on the command line: `--run-functions`
