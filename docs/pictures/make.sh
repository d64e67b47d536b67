#!/usr/bin/env bash
# Takes the pictures of the studio for README and book, docs/book/src/images/studio-*.png.
#
#   docs/pictures/make.sh
#
# It needs Node and Chromium, as `.ci/web` does. CHROMIUM names the browser where it is in no usual place.
set -eu
cd "$(dirname "$0")/../.."
[ -d studio/node_modules ] || (cd studio && npm ci --no-audit --no-fund)
cargo build --quiet -p ncc
target="${CARGO_TARGET_DIR:-target}"
case "$target" in /*) ;; *) target="$PWD/$target" ;; esac
NCC="$target/debug/ncc" node docs/pictures/make.mjs docs/book/src/images
