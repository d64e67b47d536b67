# What `ncc verify` prints, beside the differences.
verify-verdict = { $source } and { $output }: { $verdict ->
        [equal] equal
        [within-tolerance] equal within the tolerance
        [different] different
       *[not-compared] not compared
    }
verify-head-differs = differs
verify-head-compared = compared
verify-head-deviation = deviation
verify-head-source = source
verify-head-output = output

verify-events = { $events } { $events-count ->
        [one] event
       *[other] events
    } in { $set-ups ->
        [one] 1 test set-up
       *[other] { $set-ups } test set-ups
    }, to { $within } mm
verify-events-skip = { $events } { $events-count ->
        [one] event
       *[other] events
    } in { $set-ups ->
        [one] 1 test set-up
       *[other] { $set-ups } test set-ups
    } and { $settings } settings of the block-skip switches, to { $within } mm
verify-events-sampled = { $events } { $events-count ->
        [one] event
       *[other] events
    } in { $set-ups ->
        [one] 1 test set-up
       *[other] { $set-ups } test set-ups
    } and { $settings } of the settings that { $levels } block-skip switches have, to { $within } mm
verify-deviation = at most { $mm } mm, in { $axis }
verify-deviation-at = at most { $mm } mm, in { $axis }, at { $place }
verify-deviation-at-both = at most { $mm } mm, in { $axis }, at { $place } and { $output-place }
verify-first = first: { $difference }
verify-skip = { $difference } (with block skip { $levels } on)
verify-further-blocks = … and further blocks
verify-further-differences = … and { $more } more; `ncc diff --all` lists them

# What each program leaves to its control.
verify-assumed = assumed: { $facts }
verify-unconfirmed = rows that no manual confirms: { $facts }
verify-shared = not stated, as in the source: { $facts }
verify-unstated = never stated, but no event depends on it: { $facts }
verify-unstated-unsettled = never stated, and nothing settles it: { $facts }

# Why programs are different, or not compared, where no difference of their own text shows it.
verify-output-unstated = the output never states its { $facts }
verify-by-machine = by offsets, lengths or tools of the machines: neither program states them
verify-source-unexecuted = ncc cannot execute the source
verify-output-unexecuted = ncc cannot execute the output
verify-both-unexecuted = ncc cannot execute either program

# What the reader of a comparison must know.
verify-finer = a translation would be different: in the output's least increment, which the source does not resolve
verify-cycle-parameters = the cycle parameters of the source's control hold for both
