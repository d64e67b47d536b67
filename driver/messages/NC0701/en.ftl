NC0701 = { $message }
    .label = here
NC0701-kind = { $found } cannot be the value of this key
    .label = it takes { $takes }
