#pragma once

#include "experiments/ray_casting/viewed_face.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

namespace irradiff {

/// Finds the faces of a large scene that a ray may hit: a tree of boxes in single precision (Embree), wide enough that
/// what a ray of double precision hits is always among them.
class RayTree {
 public:
  /// Requires finite vertices with coordinates of at most kLargestTreeCoordinate. Throws std::runtime_error with
  /// Embree's reason where that fails.
  explicit RayTree(std::span<const SceneFace> faces);
  ~RayTree();
  RayTree(RayTree&&) noexcept;
  RayTree& operator=(RayTree&&) noexcept;
  RayTree(const RayTree&) = delete;
  RayTree& operator=(const RayTree&) = delete;

  /// Where the faces stand that the ray may hit, in any order, `visit` is called with the face's index and returns
  /// whether it is seen by the receiver at a positive inverse distance that is the greatest so far, which it then
  /// stores in `nearest`; the caller sets that to 0 first. Requires coordinates of the origin of at most
  /// kLargestTreeCoordinate and a unit direction. May be called from several threads at once.
  void visit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double& nearest,
             const std::function<bool(std::size_t)>& visit) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

/// Of vertices and of origins of rays.
inline constexpr double kLargestTreeCoordinate = 1.0;

}  // namespace irradiff
