NC0701 = { $message }
    .label = here
