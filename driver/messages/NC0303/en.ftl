NC0303 = `{ $word }` read as { $value }
    .label = no decimal point: a setting of the control decides
    .account = numbers without a decimal point, read by the control's usual setting
    .help = write a decimal point, or see the options of `ncc dialects show { $source }`
NC0303-question = numbers without a decimal point: least increments or units?
NC0303-question-word = is { $word } { $one } or { $two }?
