#!/usr/bin/env bash
# readme_block_test.sh SCRATCH: a block is extracted as it stands; a missing, doubled, open or empty one is an error.
set -euo pipefail

here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
mkdir -p "$1"
readme="$1/README.md"
failures=0

expectRejected() {
  if "$here/readme_block.sh" "$readme" "example: a.cpp" >/dev/null 2>&1; then
    echo "accepted a README with $1" >&2
    failures=$((failures + 1))
  fi
}

printf '%s\n' 'text' '```' 'other' '```' '<!-- example: a.cpp -->' '' '```cpp' 'int a;' '' '  int b;' '```' '```' 'x' '```' >"$readme"
[[ "$("$here/readme_block.sh" "$readme" "example: a.cpp")" == $'int a;\n\n  int b;' ]] || {
  echo "the block was not extracted as it stands" >&2
  exit 1
}
printf '%s\n' '<!-- example: a.cpp -->' 'text' '```' 'int a;' '```' >"$readme"
expectRejected "text between the marker and the fence"
printf '%s\n' '```cpp' 'int a;' '```' >"$readme"
expectRejected "no marker"
printf '%s\n' '<!-- example: a.cpp -->' '```' 'int a;' '```' '<!-- example: a.cpp -->' '```' 'int a;' '```' >"$readme"
expectRejected "two such blocks"
printf '%s\n' '<!-- example: a.cpp -->' '```' 'int a;' >"$readme"
expectRejected "an open fence"
printf '%s\n' '<!-- example: a.cpp -->' '```' '```' >"$readme"
expectRejected "an empty block"

((failures == 0))
