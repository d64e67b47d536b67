NC0226 = ncc cannot execute { $what }
    .label = it can be translated, but not executed
    .help = write it another way; `--to ir` keeps it
    .help-option = state it: `--from-option NAME=VALUE`, if the dialect has such an option, or `[options]` of a machine profile
