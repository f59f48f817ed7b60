#!/usr/bin/env bash
# howto_test.sh BUILD [HOWTO]: holds docs/howto/check-your-own-formula.md, or another version of it, to what it shows.
#   <!-- example: FILE -->   the block is docs/howto/examples/FILE
#   <!-- run: NAME -->       commands, run as they stand but that `./run` stands for what it has built
#   <!-- output: NAME -->    what they print: lines cut at 118 characters, numbers after six digits behind the point
#   <!-- likely: NAME -->    what the verdict of the program NAME says under "likely"
# Every block that says so is checked, and every mistake of mistakes.txt must be told of: what is replaced, by what.
set -euo pipefail

build="$1"
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
project_root="$(readlink -f "$here/../..")"
howto="${2:-$project_root/docs/howto/check-your-own-formula.md}"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

blockOf() { "$project_root/tests/build/readme_block.sh" "$howto" "$1"; }
namesOf() { sed -n "s/^<!-- $1: \(.*\) -->\$/\1/p" "$howto"; }
# Digits beyond the sixth may differ between machines.
shortened() { cut -c 1-118 | sed -E 's/([0-9]\.[0-9]{6})[0-9]*/\1/g; s/[[:space:]]+$//'; }

failures=0
# compare WHAT EXPECTED ACTUAL: files.
compare() {
  diff "$2" "$3" >"$scratch/diff" || {
    echo "$(basename "$howto"): $1: shown (<) and found (>) differ:" >&2
    cat "$scratch/diff" >&2
    failures=$((failures + 1))
  }
}

# Commands run where nothing of theirs is left behind, and find the programs in the current folder.
mkdir "$scratch/work"
ln -s "$project_root/docs" "$project_root/data" "$scratch/work"
for program in check_gradient write_samples certified_value; do
  ln -s "$build/$program" "$scratch/work/$program"
done
while IFS='|' read -r name _; do
  ln -s "$build/tests/howto/${name// /}" "$scratch/work/${name// /}"
done <"$here/mistakes.txt"

checked=0
for file in $(namesOf example); do
  blockOf "example: $file" >"$scratch/shown"
  compare "example $file" "$scratch/shown" "$project_root/docs/howto/examples/$file"
  checked=$((checked + 1))
done
for name in $(namesOf run); do
  blockOf "run: $name" | sed -E "s#\./run check [a-z_/]*/?([a-z_]+)\.cpp#./\1#; s#\./run #$build/irradiff #" >"$scratch/commands"
  blockOf "output: $name" | shortened >"$scratch/shown"
  # A verdict that something is wrong is an exit status too.
  (cd "$scratch/work" && bash "$scratch/commands" 2>"$scratch/errors" || true) | shortened >"$scratch/printed"
  compare "output $name" "$scratch/shown" "$scratch/printed"
  checked=$((checked + 1))
done
for name in $(namesOf likely); do
  blockOf "likely: $name" >"$scratch/shown"
  (cd "$scratch/work" && "./$name" || true) | awk '/^  where/ { exit } /^  likely/ { found = 1 } found' >"$scratch/printed"
  compare "likely $name" "$scratch/shown" "$scratch/printed"
  checked=$((checked + 1))
done
while IFS= read -r mistake; do
  IFS=$'\n' read -r -d '' name _ original replacement < <(sed 's/ | /\n/g' <<<"$mistake") || true
  for text in "$original" "$replacement"; do
    grep -qF "\`$text\`" "$howto" || {
      echo "$(basename "$howto"): does not name \`$text\` of the mistake $name" >&2
      failures=$((failures + 1))
    }
  done
  grep -qE "^<!-- (output|likely): $name -->\$" "$howto" || {
    echo "$(basename "$howto"): does not show what is said to the mistake $name" >&2
    failures=$((failures + 1))
  }
done <"$here/mistakes.txt"

((checked >= 10)) || {
  echo "$(basename "$howto"): only $checked blocks were found to be checked" >&2
  exit 1
}
((failures == 0))
