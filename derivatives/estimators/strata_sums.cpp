#include "derivatives/estimators/strata_sums.h"

#include "derivatives/samples/strata.h"

#include <array>
#include <cstddef>

namespace irradiff {

namespace {

/// Partial sums that are independent of each other: several additions at a time, in an order that does not depend on
/// the machine.
constexpr std::size_t kPartialSums = 8;
using PartialSums = std::array<double, kPartialSums>;

double total(const PartialSums& sums) {
  double sum = 0.0;
  for (const double part : sums) sum += part;
  return sum;
}

}  // namespace

StrataSums::StrataSums(Stratification stratification, GridShape shape) {
  const Strata strata(stratification, shape);
  projected_solid_angles_.reserve(shape.size());
  solid_angles_.reserve(shape.size());
  for (std::size_t row = 0; row < shape.rows; ++row) {
    for (std::size_t column = 0; column < shape.columns; ++column) {
      projected_solid_angles_.push_back(strata.projectedSolidAngle(row, column));
      solid_angles_.push_back(strata.solidAngle(row, column));
    }
  }
}

double StrataSums::irradiance(const HemisphereSamples& samples) const {
  PartialSums sums{};
  for (std::size_t i = 0; i < projected_solid_angles_.size(); ++i) {
    sums[i % kPartialSums] += samples.radiance[i] * projected_solid_angles_[i];
  }
  return total(sums);
}

Eigen::Vector3d StrataSums::rotationalGradient(const HemisphereSamples& samples) const {
  PartialSums along_t{};
  PartialSums along_b{};
  for (std::size_t i = 0; i < solid_angles_.size(); ++i) {
    const double weight = samples.radiance[i] * solid_angles_[i];
    along_t[i % kPartialSums] += weight * samples.direction_t[i];
    along_b[i % kPartialSums] += weight * samples.direction_b[i];
  }
  return {-total(along_b), total(along_t), 0.0};
}

}  // namespace irradiff
