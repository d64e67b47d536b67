NC0411 = message to the operator lost
    .label = { $target } cannot show a message
    .account = messages to the operator
    .help = write the message on the setup sheet
