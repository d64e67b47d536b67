NC0212 = arc with both a centre and a radius
    .label = delete one of the two
    .help = keep the centre or the radius
