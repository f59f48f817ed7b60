#include "tests/closed_forms/defining_integral.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numbers>

namespace irradiff::closed_forms_test {
namespace {

using Vector = Eigen::Matrix<long double, 3, 1>;

// The parallelogram centre + s u + t v, s and t in [-1, 1]; about its centre, so that a strip 2^20 times as long as it
// is distant keeps its digits where it is near.
Quadrature overParallelogram(const Vector& centre, const Vector& u, const Vector& v, const Vector& n) {
  const long double distance = centre.dot(u.cross(v));  // N.p times the Jacobian, the same at every p
  const auto integrand = [&](long double s, long double t) {
    const Vector p = centre + s * u + t * v;
    const long double square = p.squaredNorm();
    return n.dot(p) * distance / (std::numbers::pi_v<long double> * square * square);
  };
  return integrateOverSquare(integrand, u.norm(), v.norm());
}

// The triangle apex + a (u + b (v - u)), a and b in [0, 1], with Jacobian a |u x v|.
Quadrature overTriangle(const Vector& apex, const Vector& u, const Vector& v, const Vector& n) {
  const Vector base = v - u;
  const long double distance = apex.dot(u.cross(v));
  const auto integrand = [&](long double s, long double t) {
    const long double a = (1 + s) / 2;
    const long double b = (1 + t) / 2;
    const Vector p = apex + a * (u + b * base);
    const long double square = p.squaredNorm();
    return a * n.dot(p) * distance / (4 * std::numbers::pi_v<long double> * square * square);
  };
  return integrateOverSquare(integrand, std::max(u.norm(), v.norm()), base.norm());
}

}  // namespace

Quadrature definingIntegral(const Polygon& polygon, const Receiver& receiver) {
  const Vector x = receiver.position.cast<long double>();
  const Vector n = receiver.normal.cast<long double>();
  std::vector<Vector> r;
  for (const Eigen::Vector3d& vertex : polygon.vertices) r.push_back(vertex.cast<long double>() - x);

  if (r.size() == 4 && r[0] + r[2] == r[1] + r[3])
    return overParallelogram((r[0] + r[2]) / 2, (r[1] - r[0]) / 2, (r[3] - r[0]) / 2, n);

  Quadrature sum;
  for (std::size_t i = 1; i + 1 < r.size(); ++i) {
    const Quadrature part = overTriangle(r[0], r[i] - r[0], r[i + 1] - r[0], n);
    sum.value += part.value;
    sum.error_estimate += part.error_estimate;
    sum.cells += part.cells;
  }
  return sum;
}

}  // namespace irradiff::closed_forms_test
