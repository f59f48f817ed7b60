#pragma once

#include "derivatives/samples/hemisphere_samples.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"
#include "experiments/cache_3d/surface_radiance.h"
#include "experiments/cache_3d/visible_slice.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace irradiff {

/// The corners and edges of a scene's polygons, those that polygons share once.
struct SceneOutline {
  explicit SceneOutline(std::span<const Polygon> polygons);

  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::size_t, 2>> edges;
};

/// The frame of `tangentFrame(normal)` at a receiver.
SampleFrame sampleFrame(const Receiver& receiver);

/// A scene as one receiver sees it, to be cut into half-planes through the normal.
class SliceView {
 public:
  /// Faces that rise above the horizon, in the receiver's frame.
  struct Face {
    std::vector<Eigen::Vector3d> vertices;  ///< from the receiver
    Eigen::Vector3d inverse_plane;          ///< q with q.p = 1 for points p of the plane; 1/m
    SurfaceView radiance;
  };

  /// Refers to nothing of its arguments but the radiance.
  SliceView(std::span<const Polygon> polygons, const SurfaceRadiance& radiance, const Receiver& receiver);

  const std::vector<Face>& faces() const { return faces_; }

  /// The faces in the half-plane of an azimuth from t towards b.
  void cut(double azimuth, std::vector<SliceSegment>& segments) const;

  /// An edge along the normal: what half-planes see jumps where they pass it, and the azimuth of the jump moves by
  /// -(m.dx)/distance, m = (-sin, cos), where the receiver moves by dx.
  struct SteepEdge {
    double azimuth;
    double distance;  ///< from the normal's line; m
  };
  std::vector<SteepEdge> steepEdges(const SceneOutline& outline) const;

  /// Azimuths, ascending in [0, 2 pi), at which what a half-plane sees may begin, end or change its order: of visible
  /// vertices, of visible places where one edge passes before another, of edges on the horizon, and of steep edges.
  std::vector<double> breaks(const SceneOutline& outline) const;

 private:
  /// Where a half-plane meets an edge.
  struct EdgePoint {
    Eigen::Vector2d place;  ///< (s, h)
    Eigen::Vector3d edge;   ///< along it
  };

  static SliceEnd endOf(const EdgePoint& point, const Eigen::Vector2d& along);
  void addSegment(std::size_t face, const EdgePoint& one, const EdgePoint& other, const Eigen::Vector2d& along,
                  std::vector<SliceSegment>& segments) const;

  /// Whether a face hides what is at inverse distance `limit` in direction w, its own outline and those of inverse
  /// distance `spared` left aside.
  bool isHidden(const Eigen::Vector3d& w, double limit, double spared) const;

  SampleFrame frame_;
  std::vector<Face> faces_;
};

}  // namespace irradiff
