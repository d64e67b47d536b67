#!/usr/bin/env bash
# Bundles the page into studio/dist, which is committed, so that cargo needs no Node.
#
#   studio/build.sh [FOLDER]                 the page alone: studio/dist, or another folder
#   studio/build.sh --static FOLDER WASM     a folder for any web server, with the engine (ncc_engine.wasm: .ci/wasm builds it)
#
# The first time, the libraries are fetched: `npm ci` in studio/.
set -eu
cd "$(dirname "$0")"
[ -d node_modules ] || npm ci --no-audit --no-fund
if [ "${1:-}" = --static ]; then
    node bundle.mjs "$2" "$3"
else
    node bundle.mjs "${1:-dist}"
fi
