NC0420 = executed, and written as { $blocks } straight blocks
    .label = variables, loops, jumps and subprograms are gone
    .account = computed blocks into { $blocks } straight blocks
