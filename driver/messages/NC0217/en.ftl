NC0217 = program `{ $name }` is not in this file
    .label = called here
    .help = name the folder of the file { $file }: `-I FOLDER`; or add the program to this file, after the end
    .help-drop = if the call has no effect on the cut, leave it out: `--call { $name }=drop`
