#pragma once

#include <cstddef>
#include <vector>

namespace irradiff {

/// Nodes in (0, 1) and weights, which sum to 1.
struct GaussLegendreRule {
  std::vector<double> nodes;
  std::vector<double> weights;
};

/// The Gauss-Legendre rule with `count` nodes, 1 <= count <= kMostGaussNodes, by Newton's method on the Legendre
/// recurrence in long double; each value correct to an ulp. Rules are computed once, at the first call.
const GaussLegendreRule& gaussLegendre(std::size_t count);

inline constexpr std::size_t kMostGaussNodes = 16;

}  // namespace irradiff
