NC0211 = arc without a centre or a radius
    .label = where is its centre?
    .help-radius = add the centre (I, J, K), or the radius ({ $letter })
    .help-centre = add the centre (I, J, K)
    .help-straight = if the control moves straight to the end point (parameter 3403#5 CIR = 0): `--from-option { $option }={ $value }`
