#include "derivatives/boundary/small_source.h"

namespace irradiff {

SmallSourceRule smallSourceRule(double extent) {
  const double tau = extent / (1.0 - 2.0 * extent);
  const auto truncation = [tau](std::size_t nodes) {
    return 0x1p11 * std::pow(tau, 2.0 * static_cast<double>(nodes) - 2.0);
  };
  std::size_t nodes = 2;
  while (nodes < kMostGaussNodes && truncation(nodes) > 0x1p-54) {
    ++nodes;
  }
  return {&gaussLegendre(nodes), truncation(nodes)};
}

}  // namespace irradiff
