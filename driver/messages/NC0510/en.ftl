NC0510 = this tool cannot have its own file
    .label = this first move relies on the position of { $axis } at the change
    .help-place = program it here: a rapid move in G90 with all axes, above the work
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-inches = this tool cannot have its own file
    .label = inches cannot state the exact position of { $axis } here
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-tool = this tool cannot have its own file
    .label = this comes before the first tool change
    .help-first = move it after the first tool change
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-feed = this tool cannot have its own file
    .label = F of another tool is active here
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-speed = this tool cannot have its own file
    .label = S of another tool is active here
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-shift = this tool cannot have its own file
    .label = a shift of program zero is active at this tool change
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-length = this tool cannot have its own file
    .label = a tool length offset is active at this tool change
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-cycle = this tool cannot have its own file
    .label = a canned cycle is active at this tool change
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-compensation = this tool cannot have its own file
    .label = cutter compensation is active at this tool change
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-table = this tool cannot have its own file
    .label = a value that stays in the tables of the control
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-setting = this tool cannot have its own file
    .label = a setting that stays active for the next tools
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-switch = this tool cannot have its own file
    .label = a switch decides whether this block is executed
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-number = this tool cannot have its own file
    .label = the number of this tool is computed
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
NC0510-control = this tool cannot have its own file
    .label = its blocks have calls, labels or loops
    .help-flatten = `--pass flatten` executes the program and writes the resulting blocks
    .help = `--to-option tool_change=manual` writes one file that stops for each tool
