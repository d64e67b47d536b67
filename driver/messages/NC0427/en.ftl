NC0427 = values in an alarm left out
    .label = the alarm text has three dots instead
    .account = values in the text of an alarm left out
