#!/usr/bin/env bash
# include_directions_test.sh SCRATCH: the include check accepts a right tree and rejects each wrong include in it.
set -euo pipefail

here="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")"
right_tree="$1/right"
tree="$1/tree"
failures=0

# include FILE LINE: adds the include LINE to FILE of the tree.
include() {
  mkdir -p "$tree/${1%/*}"
  printf '#include %s\n' "$2" >>"$tree/$1"
}

restoreRightTree() {
  rm -rf "$tree"
  cp -r "$right_tree" "$tree"
}

expectRejected() {
  local file="$1" line="$2" rule="$3" message
  restoreRightTree
  include "$file" "$line"
  if message="$("$here/include_directions.sh" "$tree")"; then
    echo "accepted: $file includes $line" >&2
    failures=$((failures + 1))
  elif ! grep -F ": $rule" <<<"$message" | grep -q "^$file"; then
    echo "rejected $line in $file for another reason, expected '$rule', got: $message" >&2
    failures=$((failures + 1))
  fi
}

rm -rf "$tree" "$right_tree"
include derivatives/compensated.h '<cmath>'
include derivatives/scene/polygon.h '<Eigen/Core>'
include derivatives/boundary/arc.h '"derivatives/scene/polygon.h"'
include derivatives/boundary/arc.h '"derivatives/compensated.h"'
include derivatives/form_factor/appendix.h '"derivatives/boundary/arc.h"'
include derivatives/flatland/arc.h '"derivatives/boundary/arc.h"'
include derivatives/visibility/scene.cpp '"derivatives/flatland/arc.h"'
include verification/jets/jets.h '<ceres/jet.h>'
include verification/jets/jets.h '"derivatives/form_factor/appendix.h"'
include verification/enclosure/area.h '"derivatives/scene/polygon.h"'
include verification/exact_visibility/clip.cpp '<CGAL/Arrangement_2.h>'
include data/reference/generate.cpp '"verification/enclosure/area.h"'
include data/reference/generate.cpp '"data/reference/inputs.h"'
include experiments/cli/main.cpp '"verification/jets/jets.h"'
include tests/jets/jets_test.cpp '"experiments/io/scene_file.h"'
mv "$tree" "$right_tree"

restoreRightTree
"$here/include_directions.sh" "$tree" || { echo "a right tree was rejected" >&2; exit 1; }

expectRejected derivatives/scene/polygon.h '"verification/jets/jets.h"' 'derivatives does not build on verification'
expectRejected derivatives/scene/polygon.h '"experiments/io/scene_file.h"' 'derivatives does not build on experiments'
for foreign in '<ceres/jet.h>' '<boost/math/constants.hpp>' '<arb.h>' '<math.h>'; do
  expectRejected derivatives/scene/polygon.h "$foreign" 'derivatives depends on Eigen and the standard library alone'
done
expectRejected derivatives/scene/polygon.h '"derivatives/boundary/arc.h"' \
  'derivatives/scene is an earlier stage than derivatives/boundary'
expectRejected derivatives/boundary/arc.h '"derivatives/form_factor/appendix.h"' \
  'derivatives/boundary is an earlier stage than derivatives/form_factor'
expectRejected derivatives/estimators/hemicube.h '"derivatives/error_metric/radii.h"' \
  'derivatives/estimators is an earlier stage than derivatives/error_metric'
expectRejected derivatives/boundary/arc.h '"derivatives/flatland/arc.h"' \
  'derivatives/flatland is no stage that derivatives/boundary may include'
expectRejected derivatives/flatland/arc.h '"derivatives/form_factor/appendix.h"' \
  'flatland builds on scene and boundary alone'
expectRejected derivatives/utilities/misc.h '"derivatives/scene/polygon.h"' \
  'derivatives/utilities is no stage of derivatives'
expectRejected derivatives/compensated.h '"derivatives/scene/polygon.h"' 'a header above the stages includes no stage'
expectRejected verification/jets/jets.h '"experiments/io/scene_file.h"' 'verification does not build on experiments'
expectRejected experiments/cli/main.cpp '"tests/jets/fixture.h"' 'experiments does not build on tests'
expectRejected verification/jets/jets.h '<CGAL/Point_2.h>' 'CGAL is private to verification/exact_visibility'
expectRejected verification/jets/jets.h '"jets_detail.h"' 'an include names its room from the root'
expectRejected verification/jets/jets.h '"verification/../derivatives/scene/polygon.h"' \
  'an include names its room from the root'
expectRejected verification/jets/jets.h '<derivatives/scene/polygon.h>' 'our own headers are included in quotes'
expectRejected verification/exact_visibility/clip.cpp '"derivatives/visibility/scene.h"' \
  'an independent oracle knows derivatives/scene alone'
expectRejected verification/enclosure/area.h '"derivatives/boundary/arc.h"' \
  'an independent oracle knows derivatives/scene alone'
expectRejected data/reference/generate.cpp '"verification/jets/jets.h"' \
  'an independent oracle knows derivatives/scene alone'

rm -rf "$tree"
mkdir -p "$tree/derivatives"
if "$here/include_directions.sh" "$tree" >/dev/null; then
  echo "accepted a tree in which there was nothing to check" >&2
  failures=$((failures + 1))
fi

((failures == 0))
