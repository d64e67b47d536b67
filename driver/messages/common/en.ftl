common-also-line = also in line { $last }
common-also-lines = also in lines { $lines } and { $last }
common-also-more = also in lines { $lines } and { $more } more { $more ->
        [one] place
       *[other] places
    }
common-also-places = also at { $more } more { $more ->
        [one] place
       *[other] places
    }
common-related = belongs to it
common-allow = to accept this loss, add `--allow { $verdict }`
common-deny = stopped because of `--deny { $verdict }`
common-explain = `ncc explain { $code }` explains it
