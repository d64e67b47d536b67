NC0107 = letter O in a number
    .label = the letter O, not zero
    .help-zero = write the digit 0
    .help-word = write the digit 0: `{ $mended }`
