# What tells the dialect of a program, in `--from auto`, and where nothing does.
guess-sign = { $sign } (line { $line })
guess-text-form = the first line names the text form
guess-other-form = the first line does not name the text form
guess-canonical-calls = lines are calls of canonical functions
guess-no-call = a line is no call
guess-mark = `%` before and after the program
guess-mark-after = `%` only after the program
guess-no-mark = no `%` line in this dialect
guess-no-skip = `/` skips no block
guess-flow-words = flow words after an `O`
guess-named-variable = `#<` begins the name of a parameter
guess-no-variable = `=` without a variable
guess-foreign = `{ $sign }` is not a sign of this dialect
guess-letters = letters without numbers
guess-words-after = words after `{ $word }`
guess-centre-words = `I`, `J` and `K` in one arc
guess-numbered-main = `{ $letter }` before the main program
guess-no-number = no `{ $letter }` after `%`
guess-letter-is-zero = a letter alone means zero
guess-without-number = `{ $letter }` without a number
guess-in-block = `{ $word }` within a block
guess-unknown-code = `{ $word }` is unknown
guess-other-machine = `{ $word }` is for other machines
guess-unit-code = `{ $word }` states the unit
guess-code = `{ $word }` is a code of this dialect
guess-no-address = no word begins with `{ $letter }`
guess-length-word = `{ $word }` activates a length offset
guess-program-number = `{ $letter }` begins the program number
guess-digits = `{ $word }` has { $digits } digits
guess-comment = `{ $sign }` opens a comment
guess-comment-text = text after `;`
guess-header = `%_N_` heads a program
guess-own-word = `{ $word }` is a word of this dialect
guess-foreign-word = `{ $word }` is not a word of this dialect
guess-sets-value = `{ $word }=` sets a value

guess-empty = { $file } is empty
    .help = there is no program in it to read
guess-binary = { $file } is not a part program
    .help = there are bytes in it that no text contains; was it saved as UTF-16, or is it another file?
guess-unsure = the dialect of { $file } is not certain
    .help = name it: --from, one of { $dialects }
    .help-fits = { $dialect }: nothing speaks against it
    .help-against = { $dialect }: { $signs }
