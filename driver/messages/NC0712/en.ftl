NC0712 = { $key }: finer than the control
    .label = it has { $most } digits after the point
