NC0339 = { $kind ->
        [macro] macro calls
       *[call] calls
    } are nested { $depth } deep; older controls take { $sure }
    .label = a control that takes fewer stops with an alarm
    .help = state what your control takes: `--to-option { $option }={ $sure }`, or more
