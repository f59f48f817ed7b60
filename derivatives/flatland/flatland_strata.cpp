#include "derivatives/flatland/flatland_strata.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace irradiff {

FlatlandStrata::FlatlandStrata(FlatlandStratification stratification, std::size_t count)
    : stratification_(stratification), count_(count) {
  const std::string given = std::to_string(count) + " flatland strata: must be ";
  if (count == 0 || count > kMostFlatlandStrata) {
    throw std::invalid_argument(given + "from 1 to " + std::to_string(kMostFlatlandStrata));
  }
  if (stratification == FlatlandStratification::kSquare && count % 4 != 0) {
    throw std::invalid_argument(given + "a multiple of 4 on a square, whose upright sides are half as long as its top");
  }
}

Eigen::Vector2d FlatlandStrata::direction(std::size_t stratum, double along) const {
  // Both distances from the horizon: each is accurate next to its own end.
  const auto before = static_cast<double>(stratum);
  const auto all = static_cast<double>(count_);
  const double from_start = (before + along) / all;
  const double from_stop = ((all - before) - along) / all;
  if (stratification_ == FlatlandStratification::kCosine) {
    return {from_stop - from_start, 2.0 * std::sqrt(from_start * from_stop)};
  }
  // Four units of length from one end of the half square to the other.
  const double right_height = 4.0 * from_start;
  const double left_height = 4.0 * from_stop;
  if (right_height <= 1.0) return Eigen::Vector2d(1.0, right_height).normalized();
  if (left_height <= 1.0) return Eigen::Vector2d(-1.0, left_height).normalized();
  return Eigen::Vector2d(2.0 * (from_stop - from_start), 1.0).normalized();
}

std::vector<Eigen::Vector2d> FlatlandStrata::borders() const {
  std::vector<Eigen::Vector2d> result;
  result.reserve(count_ + 1);
  for (std::size_t i = 0; i < count_; ++i) result.push_back(direction(i, 0.0));
  result.push_back(direction(count_ - 1, 1.0));
  return result;
}

}  // namespace irradiff
