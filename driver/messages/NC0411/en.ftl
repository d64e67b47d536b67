NC0411 = message to the operator lost
    .label = { $target } cannot show a message
    .help = put the message on the setup sheet
