NC0331 = check the feed: F counts in the new unit from here on
    .label = { $before } mm/min before, { $now } mm/min here on { $source }
    .help = program F after the change of units in the source
NC0331-same = check the feed: F was programmed before the units changed
    .label = { $before } mm/min before, { $now } mm/min here on { $source }
    .help = program F after the change of units in the source
