NC0506 = target number of { $thing } { $number } is not known
    .label = the source profile has no name for it
    .help-entry = state it as `length_entry` of a tool that both profiles name; or remove all names from one profile: numbers then stay
    .help-name = give it the same name in both profiles; or remove all names from one profile: numbers then stay
NC0506-named = target number of { $thing } { $number } is not known
    .label = the target profile has no { $name }
    .help-entry = state it as `length_entry` of a tool that both profiles name; or remove all names from one profile: numbers then stay
    .help-name = give it the same name in both profiles; or remove all names from one profile: numbers then stay
