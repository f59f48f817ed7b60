#include "experiments/cache_3d/image_irradiance.h"

#include <array>
#include <cmath>
#include <utility>

namespace irradiff {

ImageIrradiance::ImageIrradiance(const Camera& camera, std::size_t width, std::vector<SeenPoint> seen,
                                 std::vector<double> values, std::vector<Eigen::Vector3d> gradients)
    : camera_(camera, width, width),
      width_(width),
      seen_(std::move(seen)),
      values_(std::move(values)),
      gradients_(std::move(gradients)),
      of_pixel_(width * width, seen_.size()) {
  for (std::size_t i = 0; i < seen_.size(); ++i) of_pixel_[seen_[i].pixel] = i;
}

std::optional<double> ImageIrradiance::at(std::size_t i, const Eigen::Vector3d& position) const {
  const std::optional<Eigen::Vector2d> place = camera_.place(position);
  if (!place) return std::nullopt;
  const double column = std::floor((*place)[0]);
  const double row = std::floor((*place)[1]);
  const auto last = static_cast<double>(width_);
  if (!(column >= -1.0 && row >= -1.0 && column < last && row < last)) return std::nullopt;
  const double x = (*place)[0] - column;
  const double y = (*place)[1] - row;
  double weights = 0.0;
  double plain = 0.0;
  double extrapolated = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Vector3d step = Eigen::Vector3d::Zero();
  for (const auto& [right, down] : std::array<std::pair<double, double>, 4>{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}}) {
    const double weight = (right > 0 ? x : 1.0 - x) * (down > 0 ? y : 1.0 - y);
    const double c = column + right;
    const double r = row + down;
    if (!(weight > 0.0 && c >= 0.0 && r >= 0.0 && c < last && r < last)) continue;
    const std::size_t k = of_pixel_[static_cast<std::size_t>(r) * width_ + static_cast<std::size_t>(c)];
    if (k == seen_.size() || seen_[k].plane != seen_[i].plane ||
        seen_[k].receiver.normal.dot(seen_[i].receiver.normal) <= 0.0) {
      continue;
    }
    const Eigen::Vector3d d = position - seen_[k].receiver.position;
    weights += weight;
    plain += weight * values_[k];
    extrapolated += weight * (values_[k] + gradients_[k].dot(d));
    gradient += weight * gradients_[k];
    step += weight * d;
  }
  if (weights == 0.0) return std::nullopt;
  return 0.5 * (extrapolated + plain + gradient.dot(step) / weights) / weights;
}

}  // namespace irradiff
