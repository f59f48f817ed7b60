#include "derivatives/estimators/strata_sums.h"

#include "derivatives/samples/strata.h"

#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

namespace irradiff {

namespace {

/// Sums that do not wait for each other; their order does not depend on the machine.
constexpr std::size_t kPartialSums = 8;
using PartialSums = std::array<double, kPartialSums>;

/// The sum of term(i) for i < count.
template <class Term>
double sumOf(std::size_t count, const Term& term) {
  PartialSums sums{};
  std::size_t first = 0;
  for (; first + kPartialSums <= count; first += kPartialSums) {
    for (std::size_t k = 0; k < kPartialSums; ++k) sums[k] += term(first + k);
  }
  for (; first < count; ++first) sums[first % kPartialSums] += term(first);
  return std::accumulate(sums.begin(), sums.end(), 0.0);
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
  const double* radiance = samples.radiance.data();
  const double* weight = projected_solid_angles_.data();
  return sumOf(projected_solid_angles_.size(), [=](std::size_t i) { return radiance[i] * weight[i]; });
}

Eigen::Vector3d StrataSums::rotationalGradient(const HemisphereSamples& samples) const {
  const double* radiance = samples.radiance.data();
  const double* weight = solid_angles_.data();
  const auto momentAlong = [&](const std::vector<double>& direction) {
    const double* component = direction.data();
    return sumOf(solid_angles_.size(), [=](std::size_t i) { return radiance[i] * weight[i] * component[i]; });
  };
  return {-momentAlong(samples.direction_b), momentAlong(samples.direction_t), 0.0};
}

}  // namespace irradiff
