NC0427 = values in an alarm left out
    .label = the alarm text has three dots instead
