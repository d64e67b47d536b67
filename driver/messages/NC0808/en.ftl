NC0808 = number without a decimal point among numbers with one
    .label = counts increments: { $read }, with a point { $other }
    .help = write the point; if the control counts whole units, state it: `--from-option`
