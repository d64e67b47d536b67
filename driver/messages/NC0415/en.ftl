NC0415 = { $holes } positions written as a { $pattern }
    .label = separate positions here
    .account = { $holes } positions into a { $pattern }
