NC0606 = a value is stated for { $variable }, and the program never uses it
    .label = nothing reads it before the program sets it
