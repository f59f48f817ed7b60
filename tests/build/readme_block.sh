#!/usr/bin/env bash
# readme_block.sh README "KIND: NAME": prints the fenced block that follows the comment <!-- KIND: NAME --> in README.
# Fails unless there is exactly one, and it is closed and not empty.
set -euo pipefail

awk -v marker="<!-- $2 -->" '
$0 == marker { ++found; waiting = 1; next }
waiting && /^```/ { waiting = 0; inside = 1; next }
waiting && NF { waiting = 0 }
inside && /^```/ { inside = 0; closed = 1; next }
inside { print; ++lines }
END { exit !(found == 1 && closed && !inside && lines > 0) }
' "$1" || {
  echo "$1: expected one fenced block after the line <!-- $2 -->" >&2
  exit 1
}
