#pragma once

#include "derivatives/scene/receiver.h"
#include "experiments/cache_3d/room.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace irradiff {

/// A surface that a pixel sees.
struct SeenPoint {
  std::size_t pixel = 0;    ///< row-major, row 0 at the top
  std::size_t polygon = 0;  ///< number
  std::size_t plane = 0;    ///< number of the first polygon of the room in the same plane
  Receiver receiver;        ///< in the plane to rounding; the normal towards the camera
  double pixel_size = 0.0;  ///< width of a pixel there, seen frontally; m
};

/// A camera's image plane: world points to places in the image and back. Columns run to the right, rows down; the
/// middle of pixel (i, j) is at (i, j).
class CameraProjection {
 public:
  /// Requires a camera that readRoom accepts.
  CameraProjection(const Camera& camera, std::size_t width, std::size_t height);

  /// Through the middle of a pixel; not of unit length: 1 along the direction of view.
  Eigen::Vector3d direction(double column, double row) const;

  /// Nothing for a point that is not in front of the camera.
  std::optional<Eigen::Vector2d> place(const Eigen::Vector3d& point) const;

  /// Width of a pixel at a point in front of the camera, seen frontally. m.
  double pixelSize(const Eigen::Vector3d& point) const;

  const Eigen::Vector3d& position() const { return position_; }
  const Eigen::Vector3d& right() const { return right_; }
  const Eigen::Vector3d& forward() const { return forward_; }

 private:
  Eigen::Vector3d position_;
  Eigen::Vector3d right_, up_, forward_;
  double pixel_;  ///< width of a pixel at distance 1
  double middle_column_, middle_row_;
};

/// What the pixels of a square image see first, ascending; without those that see nothing or an emitter.
std::vector<SeenPoint> seenPoints(const Room& room, std::size_t width);

}  // namespace irradiff
