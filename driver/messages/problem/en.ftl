# What keeps a command from being done, before any block is read.
problem-file = cannot { $action } { $name }: { $reason }
problem-not-found = there is no such file or folder
problem-denied = permission denied
problem-folder = it is a folder
problem-side-broken-off = its execution broke off; please report it with this program
problem-long-path = it makes more than { $most } moves
problem-long-output = the output would be longer than { $most } bytes
problem-long-map = its map cannot have places above 4 GiB
problem-no-store = cannot use the folder of temporary files, { $folder }: { $reason }
    .help = name a folder with free space: { $variable }=/var/tmp ncc …
problem-interrupted-at = interrupted at line { $line } of { $name }; nothing was written
problem-interrupted = interrupted; { $name } was not written
problem-is-source = { $name } is the source, and is never written over
    .help = choose another name
problem-stdout-is-source = stdout is { $name }, the source itself; the shell has emptied it
    .help = write into another file, best with `-o NAME`

problem-other-units = --units contradicts what is known: { $dialect } starts in { $units }
    .help = leave --units out, or correct the profile of the machine
problem-no-option = { $dialect } has no option `{ $option }`
    .help = it has: { $options }
    .help-none = it has no options at all
problem-no-value = `{ $value }` is not a value of { $option }
    .help = it takes: { $values }
    .help-number = it takes a number from 0, such as 0.02

problem-value-form = write it as NAME=NUMBER, such as _td=0.25 or 500=12
problem-variables = { $file }: { $reason }
    .help = write [variables], and below it a line for each: "#1" = {"{"} from = 1, to = 20 {"}"}
    .help-or = or "#2" = [0, 1], or "R5" = 12.5
problem-variable = the variable { $variable }: { $reason ->
        [apart] `from` and `to` belong together, without `among`
        [no-value] no value
        [no-number] no number
       *[range] `from` is above `to`, or `step` is not above 0
    }
problem-several-values = { $file }: the variable { $variable } has more than one value
    .help = a program is executed with one value of each variable: "#1" = 20

problem-two-files = program { $name } is in two files: { $first } and { $second }
    .help = take one out of the folder, or name the right one { $file }
problem-no-program = { $file } is named as program { $name }, but holds no whole program of { $dialect }
    .help = look at its first and its last line
problem-other-program = { $file } is named as program { $name }, but holds program { $other }
    .help = name it as the program in it, or put the right one into the folder

# What a request for the compiler as a library lacks.
problem-unread-request = the request cannot be read: { $reason }
    .help = it is a JSON object with a verb: {"{"} "verb": "translate", "file": "part.nc", … {"}"}
problem-no-message = there is no message { $name }
    .help = codes look like NC0107
problem-no-machine = there is no machine `{ $name }`
    .help = put its profile among the files
problem-profile = the profile { $name } has { $count ->
        [one] 1 error
       *[other] { $count } errors
    }
    .help = `ncc machines test` shows them
problem-no-dialect = there is no dialect `{ $name }`
    .help = there are: { $among }
problem-no-verdict = there is no verdict `{ $name }`
    .help = such as dropped, manual
problem-no-target = translate into what?
    .help = "to": "siemens"
problem-value = the value of { $name }: { $reason }
    .help = "_td": "0.25"
problem-start = the start position `{ $text }`: { $reason }
    .help = "start": "X-9,Y15.588,Z3"
problem-start-axis = `{ $word }` does not begin with one of X Y Z A B C
problem-start-decimal = `{ $word }` is no axis with a decimal, such as { $axis }15.588
problem-start-twice = { $axis } is given twice
problem-start-time = the time on the clock before the first block is not 0 or more
    .help = "start_time": 84.2
problem-no-model = there is no model of times `{ $name }`
    .help = there are: ideal, trapezoidal, jerk-limited
problem-no-pass = there is no pass `{ $name }`
    .help = `ncc passes` lists them
problem-several-files = `tool_change=file-per-tool` writes several files: a request gives one
    .help = ask for `manual`, one file that stops for each tool
problem-no-tolerance = the tolerance is no length in mm
    .help = "tolerance": "0.01"
problem-body = `{ $text }` is no body
    .help = a block is `X0:100 Y0:60 Z-20:0`, a cylinder `D50 Z-30:0`, triangles `part.stl`
problem-tool = `{ $text }` is no tool
    .help = number, shape, diameter: `4=drill,6.8,angle=118`
problem-nothing-cut = no program was cut
    .help = ask for `simulate` first
problem-payload = { $name } is not a payload: line { $line }, column { $column }: { $reason }
    .help = `ncc time --schema` prints the form of a payload
problem-payload-not-processed = block { $block } of { $name }, { $function }, has no time: the payload is not processed
    .help = write the payload with `--stage after`
problem-not-numbered = { $place }: block numbers cannot be changed because of { $reason }
    .help = --number keep leaves them as they are
problem-not-text = { $place } is not the text of a program
    .help = what is no text is never written over
problem-not-same = { $place } would not mean the same; nothing is written
    .help = this is an internal error of ncc; please report it with the program
problem-no-name = there is no name at this place
    .help = names are block numbers with a jump, labels, programs, loops and variables
problem-not-renamed = { $name } keeps its name because of { $reason }
    .help = change it by hand, and compare both programs with `ncc diff`
problem-project-faulty = { $file } has errors, and is left as it is
    .help = `ncc config` shows them
problem-project-shared = a row of { $file } is about { $program } and others
    .help = give { $program } a row of its own, or write the answer into that row
problem-project-named = { $file } cannot hold answers beside a named machine
    .help = write them into the machine's profile, under [options]
problem-project-machine-stated = { $file } states more of the machine than its control
    .help = write the machine's name there by hand, and its tools into the profile
problem-project-absent = { $file } names { $name }, and there is no such file
    .help = ncc continues without it; copy it beside the program, or correct the name
problem-project-undecided = { $program } may be for several controls, and { $file } needs one
    .help = choose the control first
