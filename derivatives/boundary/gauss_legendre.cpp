#include "derivatives/boundary/gauss_legendre.h"

#include <array>
#include <cmath>
#include <numbers>

namespace irradiff {
namespace {

GaussLegendreRule computeRule(std::size_t count) {
  GaussLegendreRule rule{std::vector<double>(count), std::vector<double>(count)};
  const auto n = static_cast<long double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    long double x = std::cos(std::numbers::pi_v<long double> * (static_cast<long double>(i) + 0.75L) / (n + 0.5L));
    long double slope = 1.0L;
    // Quadratic convergence from a start that is right to 1 / count^3: 6 steps leave nothing but rounding.
    for (int step = 0; step < 6; ++step) {
      long double previous = 1.0L;
      long double value = x;
      for (std::size_t k = 2; k <= count; ++k) {
        const auto degree = static_cast<long double>(k);
        const long double next = ((2.0L * degree - 1.0L) * x * value - (degree - 1.0L) * previous) / degree;
        previous = value;
        value = next;
      }
      slope = n * (x * value - previous) / (x * x - 1.0L);
      x -= value / slope;
    }
    rule.nodes[i] = static_cast<double>(0.5L * (1.0L - x));
    rule.weights[i] = static_cast<double>(1.0L / ((1.0L - x * x) * slope * slope));
  }
  return rule;
}

}  // namespace

const GaussLegendreRule& gaussLegendre(std::size_t count) {
  static const std::array<GaussLegendreRule, kMostGaussNodes + 1> rules = [] {
    std::array<GaussLegendreRule, kMostGaussNodes + 1> computed;
    for (std::size_t n = 1; n <= kMostGaussNodes; ++n) {
      computed[n] = computeRule(n);
    }
    return computed;
  }();
  return rules.at(count);
}

}  // namespace irradiff
