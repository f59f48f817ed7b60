#!/usr/bin/env bash
# consumer_test.sh BUILD CXX: what the README promises to a C++ user. Installs BUILD, then builds the README's minimal
# example against the installed package, in a directory outside the project, and compares what it prints with the README.
set -euo pipefail

build="$1"
compiler="$2"
here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
project_root="$(readlink -f "$here/../..")"
consumer="$(mktemp -d)"
trap 'rm -rf "$consumer"' EXIT

# quietly COMMAND...: runs the command quietly, shows its log where it fails.
quietly() {
  "$@" >"$consumer/log" 2>&1 || {
    cat "$consumer/log" >&2
    echo "failed: $*" >&2
    exit 1
  }
}

"$here/readme_block.sh" "$project_root/README.md" "example: minimal.cpp" >"$consumer/minimal.cpp"
"$here/readme_block.sh" "$project_root/README.md" "example: CMakeLists.txt" >"$consumer/CMakeLists.txt"
"$here/readme_block.sh" "$project_root/README.md" "output: minimal.cpp" >"$consumer/expected"

quietly cmake --install "$build" --prefix "$consumer/prefix"
# The root as the start of a path: in a checkout at /irradiff, lib/cmake/irradiff is none.
if grep -rnP --include='*.cmake' --include='*.h' "(?<![\\w./}-])\\Q$project_root\\E(/|\\W|\$)" "$consumer/prefix"; then
  echo "the installed files above point back into the source tree" >&2
  exit 1
fi

quietly cmake -S "$consumer" -B "$consumer/build" -G Ninja "-DCMAKE_PREFIX_PATH=$consumer/prefix" \
  "-DCMAKE_CXX_COMPILER=$compiler" -DCMAKE_BUILD_TYPE=Release
quietly cmake --build "$consumer/build"
"$consumer/build/minimal" >"$consumer/printed"
diff "$consumer/expected" "$consumer/printed" || {
  echo "the minimal example prints (>) other than the README says (<)" >&2
  exit 1
}
