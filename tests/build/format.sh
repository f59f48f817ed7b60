#!/usr/bin/env bash
# format.sh check|rewrite ROOT: holds every C++ source below ROOT against ROOT/.clang-format, or rewrites it.
set -euo pipefail

mode="$1"
cd "$2"
case "$mode" in
  check) options=(--dry-run -Werror) ;;
  rewrite) options=(-i) ;;
  *)
    echo "format.sh: expected check or rewrite, got: $mode" >&2
    exit 2
    ;;
esac

folders=()
for folder in data derivatives docs experiments tests verification; do
  [[ ! -d "$folder" ]] || folders+=("$folder")
done
mapfile -d '' sources < <(find "${folders[@]}" -type f '(' -name '*.h' -o -name '*.cpp' ')' -print0)
if ((${#sources[@]} == 0)); then
  echo "format.sh: no sources below $2" >&2
  exit 2
fi
printf '%s\0' "${sources[@]}" | xargs -0 -n 16 -P "$(nproc)" clang-format "${options[@]}"
