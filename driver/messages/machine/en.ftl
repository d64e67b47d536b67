# `ncc machines show` and `ncc machines test`.
machine-dialect = dialect: { $dialect } ({ $title })
machine-typical = typical: stands for a kind of machine, not for one that somebody has measured
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
