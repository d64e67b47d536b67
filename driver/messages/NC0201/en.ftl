NC0201 = `{ $code }` is unknown
    .label = not in the dictionary of { $source }
    .help = `ncc dialects show { $source }` lists the known codes; ncc passes no unknown code on
NC0201-machine = `{ $code }` is not a standard { $source } code
    .label = the machine builder defines it
    .help-m-code = if it has no effect on the cut, leave it out: `--m-code { $code }=drop`
    .help-m-code-target = if the target machine has it too: `--m-code { $code }=carry`; if it has another code for it: `--m-code { $code }=M…`
    .help-call = if it calls a macro with the words in its block, leave both out: `--call { $code }=drop`
