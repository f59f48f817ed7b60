#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/samples/ray_query.h"
#include "derivatives/scene/polygon.h"
#include "experiments/ray_casting/ray_tree.h"
#include "experiments/ray_casting/viewed_face.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace irradiff {

/// How the faces that a ray hits are found. The results are the same to the last bit.
enum class RaySearch {
  kAuto,       ///< as the number of polygons suggests
  kEveryFace,  ///< each ray meets each face, many rays at a time
  kTree,       ///< a tree of boxes leads to a few of them
};

/// Up to about this many polygons meeting every face is faster than a tree, also where polygons lie beside each other
/// in view, which suits trees (`./run bench`).
inline constexpr std::size_t kMostPolygonsWithoutTree = 128;

class ReceiverRays;

/// Rays in double precision among polygons, which radiate and block on both sides and may pass through each other.
///
/// Polygons enter; for each receiver ReceiverRays leave, which tell what is nearest. Each polygon is cut into triangles
/// that share their edges; rays do not leak between them (kSideRounding). Where two polygons are equally near, the
/// first one counts.
class RayCaster {
 public:
  /// Requires validated polygons, of which nothing is kept but triangles.
  explicit RayCaster(std::span<const Polygon> polygons, RaySearch search = RaySearch::kAuto);

  /// What the receiver sees. The caster must outlive it. Requires a finite position and an orthonormal frame. May be
  /// called from several threads at once. O(n) in the number of triangles.
  ReceiverRays from(const SampleFrame& frame) const;

 private:
  friend class ReceiverRays;

  int exponent_ = 0;  ///< a metre is 2^-exponent_ in the faces
  std::vector<SceneFace> faces_;
  std::optional<RayTree> tree_;
};

/// Rays from one receiver. May be used from several threads at once.
class ReceiverRays {
 public:
  /// Fills inverse_distance and radiance for the directions of the samples, whose frame must be the receiver's.
  void cast(HemisphereSamples& samples) const;

  /// A unit direction in the receiver's frame that is not below the horizon. The same bits as in `cast` for samples.
  RayHit cast(const Eigen::Vector3d& direction) const;

  /// `cast` as the estimators take it; this must outlive it.
  RayQuery query() const;

 private:
  friend class RayCaster;
  ReceiverRays(const RayCaster& caster, const SampleFrame& frame);

  RayHit castThroughTree(const Eigen::Vector3d& direction) const;

  const RayCaster* caster_;
  Eigen::Vector3d position_;  ///< in the unit of the faces
  Eigen::Matrix3d axes_;
  double inverse_unit_;  ///< inverse distances in 1/m for one of the faces
  bool uses_tree_;
  std::vector<ViewedFace> viewed_;
  std::vector<std::size_t> place_;  ///< of each face in `viewed_`, kUnseen if it is not; for the tree alone
};

}  // namespace irradiff
