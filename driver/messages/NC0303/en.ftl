NC0303 = { $word } read as { $value }
    .label = no decimal point: a setting of the control decides
    .help = write a decimal point, or see the options of `ncc dialects show { $source }`
