NC0219 = two programs have the name `{ $name }`
    .label = the second one
    .related = first here
