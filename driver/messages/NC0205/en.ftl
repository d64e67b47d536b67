NC0205 = `{ $code }` without `{ $word }`
    .label = `{ $code }` needs `{ $word }` in the same block
    .help-add = add `{ $word }` to this block
    .help-retract = without { $word } a control stops with an alarm, uses { $word } of an earlier cycle, or drills from the current position: its manual does not say which
    .help-radius-entry = write the D number of the tool radius, for example `{ $code } D1`: none is active here
    .help-no-radius = if the control moves without compensation here: `--from-option { $option }={ $value }`
    .help-h-is-radius = if H is the radius, as on a Fanuc 0, write D instead of H
    .help-entry-at-start = or state the { $word } number active at the start: `--value '#{ $variable }=NUMBER'`
NC0205-return = { $code } needs an axis on { $source }
    .label = no axis word in this block
    .help = write `G91 { $code } Z0.`, then `G90`; `G90 { $code } Z0.` moves to Z0 of the part first
