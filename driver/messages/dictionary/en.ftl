# Faults of a dictionary, each at its place in the file.
dictionary-meaning = no meaning: { $name }
    .help = `ncc dialects schema` lists the meanings
    .help-one = did you mean `{ $near }`?
    .help-several = near it are { $near }
dictionary-field = unknown field `{ $name }`
    .help = `ncc dialects schema` lists the fields of each table
    .help-one = did you mean `{ $near }`?
    .help-several = near it are { $near }
dictionary-value = unknown value `{ $name }`
    .help = it is one of { $among }
    .help-one = did you mean `{ $near }`?
    .help-several = near it are { $near }
dictionary-cycle-kind = row { $row }: no kind of cycle: { $name }
    .help = it is one of { $among }
    .help-one = did you mean `{ $near }`?
    .help-several = near it are { $near }
dictionary-missing-field = missing field `{ $field }`
    .help = add `{ $field }` to this row; `ncc dialects schema` states what it holds
    .help-source = add `source = "…"`: the manual and its page, or who states it
dictionary-not-in-base = { $row }: the base has no such row, and a new one needs more fields
    .help = `ncc dialects show` lists the rows of the base
    .help-one = did you mean `{ $near }`?
    .help-several = near it are { $near }
dictionary-code = row { $row }: never read: not a G or M code
    .help = write G or M and a number: `M52`
dictionary-number = row { $row }: never read: no code has such a number
    .help = write at most four digits, and one after the point: `G54.1`
dictionary-letter = row { $row }: never read: not a letter
    .help = an address is one letter from A to Z
dictionary-taken = row { $row }: never read: `{ $row }` begins a code or a block number
    .help = choose another letter
    .help-base = this file gives the letter to something else; remove it too: `[[{ $table }]]`, `{ $key }`, `remove = true`
dictionary-axis = row { $row }: never read: ncc has no axis { $row }
    .help = the axes are X, Y, Z, A, B and C; for any other: `refuse = "axis { $row }"`, `role = "parameter"`
dictionary-word = row { $row }: never read: no address has the letter `{ $letter }`
    .help = use a letter of [[address]], or add a row for it there
    .help-base = this file takes away what it needs; remove it too: `[[{ $table }]]`, `{ $key }`, `remove = true`
dictionary-name = row { $row }: never read: this control has no words of several letters
    .help = only dialects on siemens read [[name]] and [[call]]; a code is a row of [[code]]
dictionary-form = { $fault }
    .help = `ncc dialects schema` lists the tables and their fields
dictionary-this-base = this base is meant
dictionary-base-no-text = `base` is not a text
    .help = write the name of a dialect: `base = "fanuc"`
dictionary-missing = a dictionary states its own `{ $field }`
    .help = give it a name of its own: `id = "shop"`; a command's name cannot be one
dictionary-no-id = `{ $name }` is not a name for a dialect: letters, digits, `_` and `-`, a letter first
    .help = give it a name of its own: `id = "shop"`; a command's name cannot be one
dictionary-built-in = { $name } is built in and cannot be redefined
    .help = give it a name of its own, and build on the other: `base = "…"`
dictionary-name-twice = two files define { $name }
    .help = leave one of the files out, or rename it
dictionary-no-base = there is no dialect `{ $base }` to build on
    .help = `ncc dialects` lists the built-in ones; name a shop's file by a further --dialect
    .help-one = did you mean `{ $near }`?
dictionary-base-cycle = a dictionary cannot build on itself: { $chain }
    .help = the last base of all is one that builds on none
dictionary-other-family = a dialect has the family of its base
    .help = leave `family` out
dictionary-no-key = a row of [[{ $table }]] needs `{ $key }`
    .help = this field identifies the row; each value occurs once in a file
dictionary-row-twice = row { $row }: twice in this file
    .help = this field identifies the row; each value occurs once in a file
dictionary-nothing-there = { $row }: `{ $word }`, but the base has nothing of that name
    .help = `ncc dialects show` lists the rows of the base

# Rows that contradict another, or name what is not there.
dictionary-row = row { $row }: { $wrong }
    .help = `ncc dialects schema` states what a row needs
    .help-base = this file takes away what it needs; remove it too: `[[{ $table }]]`, `{ $key }`, `remove = true`
dictionary-NoBehaviour = no such behaviour, or no such value of it
dictionary-OtherValues = `others` has a value that the behaviour does not have
dictionary-NoOption = no such option: the variant never applies
dictionary-NoOptionValue = no such value of this option: the variant never applies
dictionary-DefaultValue = the default of its option: the variant always applies
dictionary-SeveralCodes = `upto` is for work offsets only
dictionary-MeansOrRefuse = needs either `means` or `refuse`
dictionary-FeedModeAlone = `feed_mode` is for codes of the spindle speed only
dictionary-TurnsAxis = `turns` (about X, Y or Z) is for codes that tilt the plane, which need it
dictionary-CountAlone = `count` is for work offsets with a word of their own
dictionary-NoCycleRow = has no [[cycle]] row
dictionary-NoPatternRow = has no [[pattern]] row
dictionary-NoDataRow = has no [[data]] row
dictionary-BlockLetters = `blocks` has other signs than capital letters
dictionary-NoSource = names no source
dictionary-NoNumberDefault = its default is not a number
dictionary-HandOfTap = `hand` is for tapping cycles, which need it
dictionary-ShiftOfBore = `shift` is for fine boring cycles, which need it
dictionary-ShrinkingAlone = `shrinking` needs `peck`
dictionary-DwellBy = `dwell_by` beside `dwell`, or of an option that does not exist
dictionary-Twice = two rows of this name
dictionary-CycleNotStarted = no [[code]] row starts this cycle
dictionary-PatternNotStarted = no [[code]] row makes this pattern
dictionary-NoCodeWithWord = a table is named by a code and a word
dictionary-TableNotSet = no [[code]] row puts values into this table
dictionary-ValuesOfTools = `values` is for tables of tools, which need it
dictionary-NoEntries = a table needs entries: `first` and `count` are at least 1
dictionary-NoCapitals = a name is of capital letters, digits and `_`
dictionary-OneUse = needs one of `means`, `role` and `refuse`
dictionary-RoleQuantity = `role` and `quantity` need each other
dictionary-ArgumentsEffect = `arguments` is for names without an effect
dictionary-ParameterUse = a parameter needs `role` and `quantity`, or `refuse`
dictionary-RoleTwice = two parameters of one role
dictionary-NoCode = not a code
dictionary-NeitherGNorM = not a G or M code
dictionary-NoLetter = not a letter
dictionary-FunctionOfWords = `[functions]` is for dialects of letters and numbers
dictionary-FunctionOfCode = this code has a [[code]] row: take it away with `remove = true`
dictionary-NoCommand = `command` needs a program: `["python3", "functions/g200.py"]`
dictionary-FunctionLimits = `time_limit` is 1 to 600 s, `most_blocks` 1 to 100000

# What `ncc dialects test` says of the rows of a dictionary.
dictionary-cannot-write = cannot be written: { $why }
dictionary-cannot-read = cannot be read: { $why }
dictionary-meant = meant: { $meant }
dictionary-meant-refused = meant: refused as { $name }
dictionary-not-refused = it is not refused at all
dictionary-not-written = { $word } is not written
dictionary-other-written = { $word } is not written: another word is taken
dictionary-none-written = no row is written for { $meaning }: one needs `write = true`
dictionary-no-cycle-written = no cycle `{ $kind }` is written: its [[code]] row needs `write = true`
dictionary-no-dwell-word = a dwell needs a word: `dwell = [{"{"} letter = "P", quantity = "seconds" {"}"}]`
dictionary-no-override-words = feed and speed have no words of their own
dictionary-no-hole-cycle = there is no cycle to make its holes
dictionary-other-number = it is read as another number or title
dictionary-not-used = no code, cycle or pattern uses it
dictionary-tested = { $rows ->
        [0] no rows: its form is the program's
        [one] { $rows } row tested ({ $tables }), { $failed } failed
       *[other] { $rows } rows tested ({ $tables }), { $failed } failed
    }
dictionary-unsure = { $count } not confirmed by any source (`sure = false`, marked ?): { $rows }

# Rows of the test that are no rows of a table.
dictionary-row-any-letters = comment in any letters
dictionary-row-number-by = program number by { $letter }
dictionary-row-repeat = repetition of blocks
dictionary-row-polar = points by radius and angle
