#pragma once

#include <boost/math/quadrature/gauss.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace irradiff::closed_forms_test {

/// An integral and what the quadrature itself says about its error.
struct Quadrature {
  long double value = 0;
  long double error_estimate = 0;
  std::size_t cells = 0;
};

/// A Gauss-Legendre rule on [-1, 1].
struct GaussRule {
  std::vector<long double> nodes;
  std::vector<long double> weights;
};

template <unsigned Points>
GaussRule gaussRule() {
  using Rule = boost::math::quadrature::gauss<long double, Points>;
  GaussRule rule;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    for (const long double x : {Rule::abscissa()[i], -Rule::abscissa()[i]}) {
      if (x == 0 && std::signbit(x)) continue;
      rule.nodes.push_back(x);
      rule.weights.push_back(Rule::weights()[i]);
    }
  }
  return rule;
}

/// Integral of f(s, t) over [-1, 1]^2 in long double by bisected cells, each done with 15 x 15 and 20 x 20 points; a
/// cell is bisected, across its side that is longer when s and t are worth `side_s` and `side_t`, until the two agree
/// to rounding. `noise` is the absolute rounding error of f, where that is more than a few eps of f. Needs an integrand
/// of one sign. The estimate is the sum of the differences, which is the error of the *poorer* rule, plus 64 eps of the
/// integral and `noise` everywhere for the rounding.
template <class Integrand>
Quadrature integrateOverSquare(const Integrand& f, long double side_s, long double side_t, long double noise = 0) {
  struct Cell {
    long double s, t, half_s, half_t;
  };
  static const GaussRule coarse = gaussRule<15>();
  static const GaussRule fine = gaussRule<20>();
  constexpr long double kEpsilon = std::numeric_limits<long double>::epsilon();
  constexpr long double kNegligible = 1e-25L;
  constexpr std::size_t kMaximumCells = 20000;

  const auto over = [&f](const Cell& cell, const GaussRule& rule) {
    long double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
        sum += rule.weights[i] * rule.weights[j] *
               f(cell.s + rule.nodes[i] * cell.half_s, cell.t + rule.nodes[j] * cell.half_t);
      }
    }
    return sum * cell.half_s * cell.half_t;
  };

  Quadrature result;
  std::vector<Cell> pending{{0, 0, 1, 1}};
  while (!pending.empty()) {
    const Cell cell = pending.back();
    pending.pop_back();
    const long double better = over(cell, fine);
    const long double difference = std::abs(better - over(cell, coarse));
    const long double rounding = 64 * kEpsilon * std::abs(better) + noise * 4 * cell.half_s * cell.half_t;
    if (difference <= rounding + kNegligible) {
      result.value += better;
      result.error_estimate += difference + rounding;
      ++result.cells;
      continue;
    }
    if (result.cells + pending.size() > kMaximumCells) throw std::runtime_error("quadrature: no convergence");
    Cell first = cell;
    Cell second = cell;
    if (cell.half_s * side_s >= cell.half_t * side_t) {
      first.half_s = second.half_s = cell.half_s / 2;
      first.s -= first.half_s;
      second.s += first.half_s;
    } else {
      first.half_t = second.half_t = cell.half_t / 2;
      first.t -= first.half_t;
      second.t += first.half_t;
    }
    pending.push_back(first);
    pending.push_back(second);
  }
  return result;
}

}  // namespace irradiff::closed_forms_test
