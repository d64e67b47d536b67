NC0213 = the end of the arc is not on its circle
    .label = radius { $start } mm at the start, { $end } mm at the end
    .help-absolute = check the centre: here it counts from program zero, not from the start of the arc
    .help-incremental = check the centre: here it counts from the start of the arc, not from program zero
    .help-tolerance = { $control } accepts a difference of { $allowed } mm here
    .help-tolerance-option = { $control } accepts a difference of { $allowed } mm here; if your machine accepts more: `{ $option }={ $value }`
    .help-decimal-point = or is `{ $word }`, read as { $value }, meant in whole units? Then add `{ $option }`
