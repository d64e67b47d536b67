# `ncc machines show` and `ncc machines test`.
machine-dialect = dialect: { $dialect } ({ $title })
machine-typical = typical: describes a kind of machine, not one that somebody has measured
machine-legend = (~ is marked as assumed)
machine-unconfirmed = { $rows } rows of { $dialect } are unconfirmed: `ncc dialects show { $dialect }` marks them with ?

machine-passed = passed  { $what }
machine-passed-events = passed  { $what }: { $events } events
machine-failed = failed  { $what }
machine-form = form and sense
machine-sample = a sample program, written for it and verified
machine-itself = the same, from the machine to itself
machine-codes = its { $number } M codes, written and read back
machine-not-written = { $name } is not written as { $code }
machine-tools = the names of its { $tools ->
        [one] 1 tool
       *[other] { $tools } tools
    }, from other numbers
machine-offsets = the names of its { $offsets ->
        [one] 1 work offset
       *[other] { $offsets } work offsets
    }, from other numbers
machine-tools-and-offsets = the names of its { $tools ->
        [one] 1 tool
       *[other] { $tools } tools
    } and { $offsets ->
        [one] 1 work offset
       *[other] { $offsets } work offsets
    }, from other numbers

# The values that a key takes: in `it takes …`, in the tables of the book and in the JSON Schemas.
machine-takes-text = text
machine-takes-texts = a text, or a list of texts
machine-takes-number = a number
machine-takes-number-or-word = a number, or a word in quotes
machine-takes-fact = a value, `""` for none, or a table with `value` and `source`
machine-takes-whole = a whole number
machine-takes-whole-above-zero = a whole number above 0
machine-takes-whole-between = a whole number from { $least } to { $most }
machine-takes-whole-up-to = a whole number up to { $most }
machine-takes-from-zero = a number from 0
machine-takes-above-zero = a number above 0
machine-takes-between = a number from { $least } to { $most }
machine-takes-low-and-high = two numbers, the lower one first
machine-takes-program-name = letters, digits and underlines, a letter first
machine-takes-function-name = small letters, digits and hyphens
machine-takes-m-code = `M` and a number
machine-takes-lines = a list of texts of one line each
machine-takes-extension = letters and digits
machine-takes-patterns = a pattern, or a list of them
machine-takes-machine = a profile's file, the name of a shipped profile, or a table with the keys of a profile
machine-takes-folder = a folder
machine-takes-folders = a folder, or a list of them
machine-takes-body = a block, a cylinder along Z, or a file of triangles: `X0:100 Y0:60 Z-20:0`, `D50 X0 Y0 Z-30:0`, `raw.stl`
machine-takes-bodies = such a body, or a list of them
