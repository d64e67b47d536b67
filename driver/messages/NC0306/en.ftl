NC0306 = `{ $code }` assumed to mean { $meaning }
    .label = no manual confirms this row of the dictionary
    .help = check your manual; `ncc dialects show { $source }` names the source
