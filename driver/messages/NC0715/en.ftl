NC0715 = no file can match this pattern
    .label = { $message }
    .help = write a path from the folder of this file, such as `*.nc` or `old/**/*.nc`
