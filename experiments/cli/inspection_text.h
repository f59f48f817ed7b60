#pragma once

#include "experiments/inspection/scene_inspection.h"

#include <cstddef>
#include <string>

namespace irradiff {

/// What a scene needs, for people: a summary over its receivers, then those that something is to be said about, in
/// groups. Lines of at most about 120 characters but for names and reasons.
std::string inspectionText(const SceneInspection& inspection);

/// The same summary as a JSON object without line breaks:
///
///     {"dimension": 3, "tolerance": T, "polygons": n, "receivers": n, "occlusion": n, "horizon": n,
///      "apparent_vertices": range,
///      "treatments": {"area_rule": range, ...}, "precision": {"double": n, "extended": n,
///      "ball": n}, "relative_bound": range, "hessian": {"missing": n, "undecided": n, "uncertain": n, "short": n,
///      "good": n}, "event_distance": range, "jump_distance": range, "promised_range": range, "cost": range with "sum",
///      "to_look_at": [{"title":, "count": n, "worst": [{"receiver": i, "count": n, "name":, "position":, "text":}]}]}
///
/// A range is {"least":, "median":, "largest":}, or null where there is nothing to range over.
std::string inspectionJson(const SceneInspection& inspection);

/// One receiver as a JSON object: {"receiver": i, "position": [..], "model": as in evaluate (evaluation_text.h),
/// "precision": {"expected": "double", "relative_bound":, "quantity":}, "event": {"kind":, "distance":, "rounding":,
/// "what":}, "jump": {...}, "changes_within":, "hessian": "good", "promised_range":, "cost":}. `event` and `jump` are
/// null where there is none, and so is a range that is infinite.
template <int Dimension>
std::string pointJson(std::size_t index, const PointInspection<Dimension>& point);

}  // namespace irradiff
