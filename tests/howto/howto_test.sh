#!/usr/bin/env bash
# howto_test.sh BUILD: holds docs/howto/check-your-own-formula.md to what it shows.
#   <!-- example: FILE -->   the block is docs/howto/examples/FILE
#   <!-- run: NAME -->       commands, run as they stand but that `./run` stands for what it has built
#   <!-- output: NAME -->    what they print: lines cut at 118 characters, doubles after six digits behind the point
#   <!-- likely: NAME -->    what the verdict of the program NAME says under "likely"
# Every mistake of mistakes.txt must be told of: what is replaced, by what, and what is said to it. Then changed versions
# of the how-to must be found wrong.
set -euo pipefail

build="$1"
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
project_root="$(readlink -f "$here/../..")"
howto="$project_root/docs/howto/check-your-own-formula.md"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

# blockOf HOWTO "KIND: NAME", namesOf HOWTO KIND
blockOf() { "$project_root/tests/build/readme_block.sh" "$1" "$2"; }
namesOf() { sed -n "s/^<!-- $2: \(.*\) -->\$/\1/p" "$1"; }
# Digits of a double beyond the sixth may differ between machines; those of balls may not.
shortened() { cut -c 1-118 | sed -E 's/([0-9]\.[0-9]{6})[0-9]{1,12}([^0-9]|$)/\1\2/g; s/[[:space:]]+$//'; }

# Commands run where nothing of theirs is left behind, and find the programs in the current folder.
mkdir "$scratch/place" "$scratch/printed"
ln -s "$project_root/docs" "$project_root/data" "$scratch/place"
for program in check_gradient write_samples certified_value; do
  ln -s "$build/$program" "$scratch/place/$program"
done
while read -r name _; do
  ln -s "$build/tests/howto/$name" "$scratch/place/$name"
done <"$here/mistakes.txt"
for name in $(namesOf "$howto" run); do
  blockOf "$howto" "run: $name" |
    sed -E "s#\./run check ([a-z_/]*/)?([a-z_]+)\.cpp#./\2#; s#\./run #$build/irradiff #g" >"$scratch/commands"
  # A verdict that something is wrong is an exit status too.
  (cd "$scratch/place" && bash "$scratch/commands" 2>/dev/null || true) >"$scratch/printed/output: $name"
done
for name in $(namesOf "$howto" likely); do
  (cd "$scratch/place" && "./$name" || true) |
    awk '/^  where/ { exit } /^  likely/ { found = 1 } found' >"$scratch/printed/likely: $name"
done

# faultsOf HOWTO: what it shows that is not so, one after the other; nothing if all is.
faultsOf() {
  local checked=0 block mistake name original replacement text
  while IFS= read -r block; do
    checked=$((checked + 1))
    case "$block" in
      example:*) diff <(blockOf "$1" "$block") "$project_root/docs/howto/examples/${block#example: }" ;;
      *) diff <(blockOf "$1" "$block" | shortened) <(shortened <"$scratch/printed/$block") ;;
    esac || echo "$block: shown (<) and found (>) differ"
  done < <(sed -nE 's/^<!-- ((example|output|likely): .*) -->$/\1/p' "$1")
  ((checked >= 14)) || echo "only $checked blocks were found to be checked"
  while IFS= read -r mistake; do
    name="${mistake%% | *}"
    replacement="${mistake##* | }"
    original="${mistake% | *}"
    original="${original##* | }"
    for text in "$original" "$replacement"; do
      grep -qF "\`$text\`" "$1" || echo "$name: \`$text\` is not told of"
    done
    grep -qE "^<!-- (output|likely): $name -->\$" "$1" || echo "$name: what is said to it is not shown"
  done <"$here/mistakes.txt"
}

failures=0
faults="$(faultsOf "$howto")"
[[ -z "$faults" ]] || {
  echo "$howto:" >&2
  echo "$faults" >&2
  failures=1
}
# expectFaults WHAT SED: in the how-to with that change.
expectFaults() {
  sed "$2" "$howto" >"$scratch/changed.md"
  ! cmp -s "$howto" "$scratch/changed.md" || { echo "the change \"$1\" changes nothing" >&2; failures=1; }
  [[ -n "$(faultsOf "$scratch/changed.md" 2>&1)" ]] || { echo "accepted a how-to with $1" >&2; failures=1; }
}
expectFaults "another program" 's/sum += w.cross/sum += 2.0 * w.cross/'
expectFaults "another count" 's/WRONG on 100 of 100/WRONG on 99 of 100/'
expectFaults "another cause" 's/^  likely   the last edge.*/  likely   the first edge/'
expectFaults "another value" 's/"irradiance":1.2333/"irradiance":1.2334/'
expectFaults "another mistake" 's/`sum -= w`/`sum = w`/'
expectFaults "a verdict left out" '/^<!-- likely: check_gradient_pi -->$/d'
((failures == 0))
