#pragma once

#include "experiments/inspection/point_inspection.h"
#include "experiments/io/scene_file.h"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace irradiff {

/// Values over the receivers of a scene; those that are not finite are counted apart.
class ValueRange {
 public:
  void add(double value);
  bool isEmpty() const { return values_.empty(); }
  std::size_t infinite() const { return infinite_; }
  /// Require a value.
  double least() const;
  double median() const;
  double largest() const;
  double sum() const;

 private:
  std::vector<double> values_;
  std::size_t infinite_ = 0;
};

/// A receiver that something is to be said about, or several of which the same is.
struct NotedPoint {
  std::size_t index = 0;  ///< of the scene's receivers, as messages count them; the first of several
  std::size_t count = 1;  ///< receivers with the same text
  double severity = 0.0;  ///< the largest are kept
  std::string name;       ///< "points[2]" or "grid (3, 7)"
  std::string position;   ///< "[0, 1, 0.5]"
  std::string text;       ///< what and why
};

/// Receivers that are noted for the same thing.
struct NotedGroup {
  std::string title;
  std::size_t count = 0;
  std::vector<NotedPoint> worst;  ///< at most kNotedPoints, by severity, and equal ones in the order of the scene
};

inline constexpr std::size_t kNotedPoints = 4;

/// The receivers of one scene in a few figures.
struct SceneInspection {
  int dimension = 3;
  std::string description;
  double tolerance = kDefaultTolerance;
  std::size_t sources = 0;  ///< polygons or segments
  std::size_t receivers = 0;
  std::size_t with_occlusion = 0;
  std::size_t with_horizon = 0;
  std::size_t with_apparent_vertices = 0;
  ValueRange apparent_vertices;
  /// In the order of kTreatments.
  std::array<ValueRange, 8> treatments;
  std::array<std::size_t, kRungs.size()> rungs{};
  ValueRange relative_bounds;
  std::array<std::size_t, kHessianUses.size()> hessians{};
  ValueRange event_distances, jump_distances, promised_ranges, costs;
  std::vector<NotedGroup> groups;  ///< those that hold a receiver
};

/// What may become of a source, with the field of SourceCounts and how a text calls it.
struct Treatment {
  const char* field;
  const char* text;
  std::size_t SourceCounts::*count;
};

extern const std::array<Treatment, 8> kTreatments;

/// Where findings on single receivers go, in the order of the scene's receivers; each may be empty.
struct InspectionSinks {
  std::function<void(std::size_t, const PointInspection<3>&)> take;
  std::function<void(std::size_t, const PointInspection<2>&)> take_flatland;
  std::function<void(std::size_t done, std::size_t all)> progress;
};

/// Inspects all receivers; looks for a confirmed change (PointInspection) at those that are no grid's, in 3D. Throws
/// InvalidScene as the evaluation does.
SceneInspection inspectScene(const Scene& scene, double tolerance, const InspectionSinks& sinks);

/// How many of the receivers are "points" of the file; the rest is its grid.
std::size_t pointCount(const Scene& scene);

}  // namespace irradiff
