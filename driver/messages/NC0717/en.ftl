NC0717 = no file matches `{ $pattern }`
    .label = below the folder of this file
    .help = patterns start in the folder of this file; `*` stays in one folder, `**/` goes down
