NC0704 = `{ $value }` is not a value of { $option }
    .label = it takes: { $takes }
NC0704-number = `{ $value }` is not a value of { $option }
    .label = it takes a number from 0
