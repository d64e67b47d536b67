NC0520 = { $target } does not accept the two radii of this arc
    .label = radius { $start } mm at the start, { $end } mm at the end
    .help = correct the centre, so that both radii are equal
    .help-tolerance = { $control } accepts a difference of { $allowed } mm here
    .help-tolerance-option = { $control } accepts a difference of { $allowed } mm here; if your machine accepts more: `{ $option }={ $value }`
