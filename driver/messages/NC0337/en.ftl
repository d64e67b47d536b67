NC0337 = `{ $code }` goes through { $words } in program coordinates
    .label = G90 and G91 in one block: the last one counts
    .help = state what your machine does: `--from-option return_distance=last` or `=first`
NC0337-straight = `{ $code }` goes straight from the current position
    .label = G90 and G91 in one block: the last one counts
    .help = state what your machine does: `--from-option return_distance=last` or `=first`
NC0337-incremental = `{ $code }` first moves by { $words } from the current position
    .label = G90 and G91 in one block: the last one counts
    .help = state what your machine does: `--from-option return_distance=last` or `=first`
NC0337-question = does G90 or G91 count in this block?
NC0337-question-path = { $code } { $one }, or { $two }?
