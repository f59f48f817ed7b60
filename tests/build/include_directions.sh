#!/usr/bin/env bash
# include_directions.sh ROOT: fails on an include that runs against the architecture, one line for each:
#   derivatives -> Eigen and the standard library; verification -> derivatives; docs -> both; experiments and tests -> all of these
#   a stage of derivatives -> earlier stages; flatland -> scene and boundary; visibility and later stages -> flatland
#   an oracle that must be independent of the formulas reaches no stage of derivatives but scene, on any path
#   CGAL is seen by verification/exact_visibility alone
set -euo pipefail
cd "$1"

folders=()
for folder in data derivatives docs experiments tests verification; do
  [[ ! -d "$folder" ]] || folders+=("$folder")
done

{ grep -rHE --include='*.h' --include='*.cpp' '^[[:space:]]*#[[:space:]]*include' "${folders[@]}" || true; } | awk '
function reject(rule) {
  print file ": includes " shown ": " rule
  rejected = 1
}

# The first two components of a path name a stage or a room; a header that lies directly in derivatives/ is no stage.
function roomOf(path,  part, count) {
  count = split(path, part, "/")
  return count > 2 ? part[1] "/" part[2] : part[1]
}

function checkStage(from, to) {
  if (from == to || to == "derivatives") return
  if (from == "derivatives") { reject("a header above the stages includes no stage"); return }
  if (from == "derivatives/flatland") {
    if (to != "derivatives/scene" && to != "derivatives/boundary") reject("flatland builds on scene and boundary alone")
    return
  }
  if (to == "derivatives/flatland" && stage[from] >= stage["derivatives/visibility"]) return
  if (!(from in stage)) { reject(from " is no stage of derivatives"); return }
  if (!(to in stage)) { reject(to " is no stage that " from " may include"); return }
  if (stage[to] > stage[from]) reject(from " is an earlier stage than " to)
}

# Follows the includes of `path`; `chain` is how it was reached.
function checkIndependence(path, chain,  target, i, count) {
  if (path in visited) return
  visited[path] = 1
  count = includes[path]
  for (i = 1; i <= count; ++i) {
    target = edge[path, i]
    if (target ~ /^derivatives\// && roomOf(target) != "derivatives/scene") {
      file = chain; shown = "\"" target "\""
      reject("an independent oracle knows derivatives/scene alone")
    } else {
      checkIndependence(target, chain " -> " target)
    }
  }
}

BEGIN {
  count = split("scene boundary form_factor visibility samples estimators error_metric", order, " ")
  for (i = 1; i <= count; ++i) stage["derivatives/" order[i]] = i
  mayInclude["derivatives"] = "derivatives"
  mayInclude["verification"] = "derivatives verification"
  mayInclude["data"] = "derivatives verification data"
  mayInclude["docs"] = "derivatives verification"
  mayInclude["experiments"] = "derivatives verification experiments"
  mayInclude["tests"] = "derivatives verification experiments tests"
}

{
  file = substr($0, 1, index($0, ":") - 1)
  text = substr($0, index($0, ":") + 1)
  sub(/^[[:space:]]*#[[:space:]]*include[[:space:]]*/, "", text)
  ++checked
  room = file
  sub(/\/.*/, "", room)
  quoted = text ~ /^"/
  target = substr(text, 2)
  sub(/[">].*$/, "", target)
  shown = (quoted ? "\"" target "\"" : "<" target ">")

  if (text !~ /^("[^"]+"|<[^>]+>)/) { reject("neither a quoted nor an angled path"); next }
  if (!quoted) {
    if (target ~ /^(data|derivatives|experiments|tests|verification)\//) reject("our own headers are included in quotes")
    if (room == "derivatives" && target !~ /^(Eigen\/[A-Za-z]+|[a-z_]+)$/) reject("derivatives depends on Eigen and the standard library alone")
    if (target ~ /^CGAL\// && file !~ /^verification\/exact_visibility\//) reject("CGAL is private to verification/exact_visibility")
    next
  }
  owner = target
  sub(/\/.*/, "", owner)
  if (target ~ /(^|\/)\.\.?\// || !(owner in mayInclude)) { reject("an include names its room from the root"); next }
  if (index(" " mayInclude[room] " ", " " owner " ") == 0) { reject(room " does not build on " owner); next }
  if (room == "derivatives") checkStage(roomOf(file), roomOf(target))
  edge[file, ++includes[file]] = target
}

END {
  for (path in includes) {
    if (path ~ /^(data\/|verification\/(closed_forms|enclosure|exact_visibility|reference|visible_region)\/)/) {
      split("", visited)
      checkIndependence(path, path)
    }
  }
  if (checked == 0) { print "no includes found: nothing was checked"; exit 1 }
  exit rejected
}
'
