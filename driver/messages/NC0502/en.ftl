NC0502 = a second work offset, but { $target } has only one
    .label = offset { $second } here; the program starts with offset { $first }
    .related = first here
    .help = make one program for each work offset
