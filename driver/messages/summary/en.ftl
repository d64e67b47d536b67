# The account of a translation.
summary-verified = verified
summary-not-verified = NOT VERIFIED
summary-events = the same { $events } events in source and output, in { $set-ups ->
        [one] 1 test set-up
       *[other] { $set-ups } test set-ups
    }
summary-events-skips = the same { $events } events in source and output, in { $set-ups ->
        [one] 1 test set-up
       *[other] { $set-ups } test set-ups
    } and { $skips } settings of the block-skip switches
summary-lost = lost
summary-check = check at the machine
summary-usual = usual defaults
summary-no-effect = no effect on the cut
summary-not-answered = not answered
summary-more-phrases = … and { $more } more; `--verbose` or `--report` lists them
summary-more-in-list = … and { $more } more
summary-all-in-list = (`-v` lists them)
summary-verification-failed = verification failed
summary-not-translated = not translated
summary-nothing-written = nothing was written
summary-questions = { $count ->
        [one] 1 question
       *[other] { $count } questions
    }
summary-errors = { $count ->
        [one] 1 error
       *[other] { $count } errors
    }
summary-losses = { $count ->
        [one] 1 verdict that is not allowed
       *[other] { $count } verdicts that are not allowed
    }
summary-straight = `--pass flatten` executes the program and writes the resulting blocks
summary-straight-switch = `--pass flatten` executes the program and writes the resulting blocks, with `--from-option block_skip=off` or `=on`
summary-straight-without-motion = `--pass flatten` executes the program and writes the resulting blocks; if your control ignores blocks without motion, add `--from-option block_without_way=looked-over`
summary-line = line { $line }
summary-lines = lines { $lines } and { $last }
summary-lines-more = lines { $lines } and { $more } more
summary-places = { $more } places
summary-file-line = { $file } line { $lines }
summary-file-line-more = { $file } line { $lines } and { $more } elsewhere

# What `ncc.toml` answers, where options state all of it.
summary-no-answers = nothing that is not stated by options
