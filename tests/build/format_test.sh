#!/usr/bin/env bash
# format_test.sh SCRATCH: the formatting check accepts a formatted source and rejects, and repairs, a bad one.
set -euo pipefail

here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
tree="$1"
rm -rf "$tree"
mkdir -p "$tree/derivatives"
cp "$here/../../.clang-format" "$tree"

printf '#pragma once\n\nint twice(int value);\n' >"$tree/derivatives/twice.h"
"$here/format.sh" check "$tree" || { echo "a formatted source was rejected" >&2; exit 1; }

printf '#pragma once\n\nint  thrice( int value );\n' >"$tree/derivatives/thrice.h"
if "$here/format.sh" check "$tree" 2>"$tree/message"; then
  echo "a badly formatted source was accepted" >&2
  exit 1
fi
grep -q 'derivatives/thrice.h' "$tree/message" || { echo "the message does not name the source" >&2; exit 1; }

"$here/format.sh" rewrite "$tree"
"$here/format.sh" check "$tree" || { echo "a rewritten source was rejected" >&2; exit 1; }
