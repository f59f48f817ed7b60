#pragma once

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace irradiff {

/// The integrals of several functions at once from `from` to `to`, by Gauss-Kronrod quadrature with 21 points in halved
/// intervals until each function's error estimate (Piessens et al., QUADPACK, 1983) is at most its tolerance, or as
/// small as rounding lets it be.
template <std::size_t Count, class Integrand>
std::array<double, Count> adaptiveIntegrals(const Integrand& integrand, double from, double to,
                                            const std::array<double, Count>& tolerance) {
  using Values = std::array<double, Count>;
  static const auto& nodes = boost::math::quadrature::gauss_kronrod<double, 21>::abscissa();
  static const auto& weights = boost::math::quadrature::gauss_kronrod<double, 21>::weights();
  static const auto& gauss_weights = boost::math::quadrature::gauss<double, 10>::weights();
  constexpr double kRounding = 50.0 * std::numeric_limits<double>::epsilon();
  constexpr std::size_t kDeepest = 40;
  struct Interval {
    double from, to;
    std::size_t depth;
  };
  Values sum{};
  std::vector<Interval> waiting{{from, to, 0}};
  while (!waiting.empty()) {
    const Interval interval = waiting.back();
    waiting.pop_back();
    const double middle = 0.5 * (interval.from + interval.to);
    const double half = 0.5 * (interval.to - interval.from);
    std::array<Values, 21> values;
    Values kronrod{};
    Values gauss{};
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (const bool is_left : {false, true}) {
        if (k == 0 && is_left) continue;
        const std::size_t place = is_left ? nodes.size() + k - 1 : k;
        values[place] = integrand(middle + (is_left ? -half : half) * nodes[k]);
        for (std::size_t i = 0; i < Count; ++i) {
          kronrod[i] += weights[k] * values[place][i];
          if (k % 2 == 1) gauss[i] += gauss_weights[k / 2] * values[place][i];
        }
      }
    }
    bool is_fine = true;
    for (std::size_t i = 0; i < Count && is_fine; ++i) {
      double size = 0.0;
      double spread = 0.0;
      for (std::size_t place = 0; place < values.size(); ++place) {
        const double weight = weights[place < nodes.size() ? place : place - nodes.size() + 1] * half;
        size += weight * std::abs(values[place][i]);
        spread += weight * std::abs(values[place][i] - 0.5 * kronrod[i]);
      }
      const double difference = std::abs(kronrod[i] - gauss[i]) * half;
      const double error = spread > 0.0 ? spread * std::min(1.0, std::pow(200.0 * difference / spread, 1.5)) : 0.0;
      is_fine = error <= std::max(tolerance[i], kRounding * size);
    }
    if (is_fine || interval.depth == kDeepest) {
      for (std::size_t i = 0; i < Count; ++i) sum[i] += half * kronrod[i];
    } else {
      // The nearer half first, so that sums run from one end to the other.
      waiting.push_back({middle, interval.to, interval.depth + 1});
      waiting.push_back({interval.from, middle, interval.depth + 1});
    }
  }
  return sum;
}

}  // namespace irradiff
