NC0204 = no code in this block uses `{ $word }`
    .label = unused word
    .help = delete the word, or add the code that it belongs to
