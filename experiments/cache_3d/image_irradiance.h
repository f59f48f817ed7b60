#pragma once

#include "experiments/cache_3d/camera_view.h"
#include "experiments/cache_3d/room.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace irradiff {

/// True irradiance between the pixels of a view, from its values and tangential gradients at what they see.
class ImageIrradiance {
 public:
  /// `values` (W/m^2) and `gradients` (W/m^3, world axes) of each of `seen`.
  ImageIrradiance(const Camera& camera, std::size_t width, std::vector<SeenPoint> seen, std::vector<double> values,
                  std::vector<Eigen::Vector3d> gradients);

  const std::vector<SeenPoint>& seen() const { return seen_; }
  double value(std::size_t i) const { return values_[i]; }
  const Eigen::Vector3d& gradient(std::size_t i) const { return gradients_[i]; }

  // At a point of the plane of seen[i]: from the four pixels around its place in the image, those on the same side of
  // the same plane, by bilinear weights w_k, summing to 1. With d_k from pixel k's point to this one,
  //   1/2 sum w_k (E_k + g_k.d_k)  +  1/2 (sum w_k E_k + (sum w_k g_k).(sum w_k d_k)):
  // both are right for linear functions, and their errors of second order are opposite but for that of sum w_k d_k,
  // which perspective alone leaves. Nothing where none of the four is on it: the camera does not see the point, and no
  // receiver is there. W/m^2.
  std::optional<double> at(std::size_t i, const Eigen::Vector3d& position) const;

 private:
  CameraProjection camera_;
  std::size_t width_;
  std::vector<SeenPoint> seen_;
  std::vector<double> values_;
  std::vector<Eigen::Vector3d> gradients_;
  std::vector<std::size_t> of_pixel_;  ///< number in seen_, or seen_.size()
};

}  // namespace irradiff
