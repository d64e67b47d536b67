NC0415 = { $holes } positions folded into a { $pattern }
    .label = separate positions here
    .account = { $holes } positions into a { $pattern }
