NC0603 = not every setting of { $levels } block-skip switches was tried
    .label = each switch alone and each pair were tried
