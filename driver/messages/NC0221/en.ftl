NC0221 = tool change without a tool number
    .label = no T word before this block
    .help = write the tool number in this block: `T1 M06` for tool 1
    .help-first-tool = if a tool is preselected at the start of the program: `--from-option { $option }=1` for tool 1
