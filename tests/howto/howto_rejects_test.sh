#!/usr/bin/env bash
# howto_rejects_test.sh BUILD: howto_test.sh finds fault with a how-to whose program, output, verdict or mistake is another.
set -euo pipefail

here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
howto="$(readlink -f "$here/../../docs/howto/check-your-own-formula.md")"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
failures=0

# expectRejected WHAT SED: the how-to with that change.
expectRejected() {
  sed "$2" "$howto" >"$scratch/changed.md"
  ! cmp -s "$howto" "$scratch/changed.md" || {
    echo "the change \"$1\" changes nothing" >&2
    exit 1
  }
  if "$here/howto_test.sh" "$build" "$scratch/changed.md" >/dev/null 2>&1; then
    echo "accepted a how-to with $1" >&2
    failures=$((failures + 1))
  fi
}

build="$1"
expectRejected "another program" 's/sum += w.cross/sum += 2.0 * w.cross/'
expectRejected "another verdict" 's/WRONG on 100 of 100/WRONG on 99 of 100/'
expectRejected "another cause" 's/^  likely   the last edge.*/  likely   the first edge/'
expectRejected "another mistake" 's/`sum -= w`/`sum = w`/'
((failures == 0))
