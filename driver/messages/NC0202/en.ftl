NC0202 = `{ $code }` is not supported: { $name }
    .label = ncc does not translate it
    .help = write this block another way, or edit it by hand
    .help-m-code = if it has no effect on the cut, leave it out: `--m-code { $code }=drop`
    .help-m-code-target = if the target machine has it too: `--m-code { $code }=carry`; if it has another code for it: `--m-code { $code }=M…`
    .help-variant = if the control of this program has { $code }: `{ $options }`
    .help-option = state what the control does with it: { $options }; otherwise delete it
    .help-run-once = to run it once: delete this block, and end the program with M30
    .help-subprogram = if another program calls this one: delete the M30, and give it its own program number
    .help-no-axis = delete `{ $code }`, or add an axis word: its block has none
    .help-no-axis-nothing = if no axis moves on the control: `--from-option { $option }={ $value }`
    .help-system-variable = state its value, if it is the same at each place that reads it: `--value '{ $code }=NUMBER'`
    .help-cancel-cycle = add `G80` before this block: a call or a jump may arrive with a cycle active
    .help-feed-unit = state the basic unit of the machine, in which F counts under G70 and G71: `--from-option feed_unit=inch` or `feed_unit=mm`
    .help-definition = state its value at the start, if a definition file sets it: `--value { $code }=NUMBER`
    .help-assignments = if only the control's own programs read it, leave its assignments out: `--value { $code }=drop`
    .help-radius-entry = write the D number of the tool radius in this block: for example `{ $code } D1` for entry 1
    .help-no-radius = if the control moves without compensation here: `--from-option { $option }={ $value }`
    .help-entry-at-start = state the number active at the start: `--value '#{ $variable }=NUMBER'`
    .help-or-entry = or write the number of the entry instead: for example `P1`
    .help-entry-word = write the { $letter } number in this block: for example `{ $code } { $letter }1` for entry 1
    .help-entry = write the number of the entry instead: for example `P1`
    .help-main = translate the program that calls this one: `-I FOLDER` finds both
    .help-timer = delete the blocks that set and read the timer, if they only detect a run in graphics
    .help-probe = probe with `G38.2`, which stops with an alarm if the probe touches nothing, and delete this check
    .help-data-input = delete these blocks, and set the parameter at the machine
    .help-table-entry = write the number of the entry instead: `#2001` for the length of entry 1
    .help-pocket = the control computes this path: post the pocket as moves, with `G01`, `G02` and `G03`
