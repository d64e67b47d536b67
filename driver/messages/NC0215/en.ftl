NC0215 = an arc with a radius word ends at its start point
    .label = any number of circles would fit
    .help = write a full circle with its centre (I, J, K)
