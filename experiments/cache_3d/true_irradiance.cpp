#include "experiments/cache_3d/true_irradiance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace irradiff {
namespace {

/// The cell between two receivers along one side, and where in it; beyond the outermost receivers up to half a cell
/// outside.
struct Span {
  std::size_t first;
  std::size_t second;
  double share;
};

Span spanOf(double place, std::size_t count) {
  const double last = static_cast<double>(count) - 2.0;
  const double first = std::max(0.0, std::min(std::floor(place), last));
  const auto index = static_cast<std::size_t>(first);
  return {index, std::min(index + 1, count - 1), count > 1 ? place - first : 0.0};
}

}  // namespace

TrueIrradiance::TrueIrradiance(const ReceiverGrid& grid, std::vector<double> values,
                               std::vector<Eigen::Vector3d> gradients)
    : grid_(grid), values_(std::move(values)), gradients_(std::move(gradients)) {}

std::optional<double> TrueIrradiance::at(const Eigen::Vector3d& position) const {
  const Eigen::Vector3d from_origin = position - grid_.origin;
  const double u = from_origin.dot(grid_.u) / grid_.u.squaredNorm();
  const double v = from_origin.dot(grid_.v) / grid_.v.squaredNorm();
  if (!(u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0)) return std::nullopt;
  const Span column = spanOf(u * static_cast<double>(grid_.width) - 0.5, grid_.width);
  const Span row = spanOf(v * static_cast<double>(grid_.height) - 0.5, grid_.height);
  double sum = 0.0;
  const auto add = [&](std::size_t i, std::size_t j, double weight) {
    const std::size_t k = j * grid_.width + i;
    sum += weight * (values_[k] + 0.5 * gradients_[k].dot(position - grid_.receiver(i, j).position));
  };
  add(column.first, row.first, (1.0 - column.share) * (1.0 - row.share));
  add(column.second, row.first, column.share * (1.0 - row.share));
  add(column.first, row.second, (1.0 - column.share) * row.share);
  add(column.second, row.second, column.share * row.share);
  return sum;
}

}  // namespace irradiff
