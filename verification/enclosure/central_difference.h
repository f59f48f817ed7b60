#pragma once

#include "derivatives/scene/receiver.h"
#include "verification/enclosure/ball.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace irradiff::enclosure {

/// Value, gradient and Hessian of a function of the receiver's displacement.
template <int Dimension>
struct DifferenceQuotients {
  Ball value;
  Eigen::Matrix<Ball, Dimension, 1> gradient;
  Eigen::Matrix<Ball, Dimension, Dimension> hessian;
};

/// Central differences of f(displacement) with steps s = 1e-40 length and s/10. The balls are those of the smaller
/// step, widened by the change between the two: the truncation error of second order is 1/99 of it, to leading order.
/// An estimate. The working precision must leave the digits wanted after a loss of 82 to the second difference.
template <int Dimension, class Function>
DifferenceQuotients<Dimension> differenceTwice(const Function& f, double length) {
  using Displacement = Eigen::Matrix<Ball, Dimension, 1>;
  const Displacement origin;
  DifferenceQuotients<Dimension> result;
  result.value = f(origin);
  for (int refinement = 0; refinement < 2; ++refinement) {
    const Ball step = Ball(length) * Ball::fromDecimal(refinement == 0 ? "1e-40" : "1e-41").midpoint();
    const auto at = [&](Eigen::Index i, int a, Eigen::Index j, int b) {
      Displacement d = origin;
      d(i) += Ball(a) * step;
      d(j) += Ball(b) * step;
      return f(d);
    };
    const auto widened = [&](const Ball& previous, Ball current) {
      if (refinement == 1) {
        const Ball change = abs(current - previous);
        arb_add_error(current.get(), change.get());
      }
      return current;
    };
    for (Eigen::Index i = 0; i < Dimension; ++i) {
      const Ball up = at(i, 1, i, 0);
      const Ball down = at(i, -1, i, 0);
      result.gradient(i) = widened(result.gradient(i), (up - down) / (Ball(2) * step));
      result.hessian(i, i) = widened(result.hessian(i, i), (up - Ball(2) * result.value + down) / (step * step));
      for (Eigen::Index j = i + 1; j < Dimension; ++j) {
        const Ball mixed =
            (at(i, 1, j, 1) - at(i, 1, j, -1) - at(i, -1, j, 1) + at(i, -1, j, -1)) / (Ball(4) * step * step);
        result.hessian(i, j) = result.hessian(j, i) = widened(result.hessian(i, j), mixed);
      }
    }
  }
  return result;
}

/// A thousandth of the smallest distance to an edge or height of a vertex over the horizon: F and E are analytic over
/// it. Metres. Precondition: the receiver is on no edge and no vertex on the horizon.
template <int Dimension>
double smoothLength(const std::vector<Eigen::Matrix<double, Dimension, 1>>& vertices,
                    const ReceiverIn<Dimension>& receiver) {
  double scale = 0;
  for (const auto& vertex : vertices) scale = std::max(scale, (vertex - receiver.position).cwiseAbs().maxCoeff());
  double length = 1;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Eigen::Matrix<double, Dimension, 1> r = (vertices[i] - receiver.position) / scale;
    Eigen::Matrix<double, Dimension, 1> next = (vertices[(i + 1) % vertices.size()] - receiver.position) / scale;
    // From the nearer end: from the other one a vertex much nearer than the edge is long would be lost in the sum.
    if (next.squaredNorm() < r.squaredNorm()) std::swap(r, next);
    const Eigen::Matrix<double, Dimension, 1> e = next - r;
    const double t = std::clamp(-r.dot(e) / e.squaredNorm(), 0.0, 1.0);
    // Terms of the height may cancel to bits that only their exact products have.
    Ball height;
    for (int k = 0; k < Dimension; ++k) {
      height += Ball(receiver.normal(k)) * (Ball(vertices[i](k)) - Ball(receiver.position(k)));
    }
    length = std::min({length, (r + t * e).norm(), abs(height).toDouble() / scale});
  }
  return scale * length * 1e-3;
}

}  // namespace irradiff::enclosure
