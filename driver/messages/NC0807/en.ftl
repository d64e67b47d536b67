NC0807 = rapid move below Z{ $plane }
    .label = in rapid at Z{ $z }
    .help = program a feed move below the plane
NC0807-cycle = rapid move below Z{ $plane }
    .label = the tool moves to its R plane, Z{ $z }, in rapid
    .help = program a feed move below the plane
