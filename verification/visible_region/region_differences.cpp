#include "verification/visible_region/region_differences.h"

namespace irradiff {
namespace {

using Digits = Multiprecision;
using Vector = MultiprecisionVector;

/// The projection of the axis least aligned with n, and n x that: irradiance.h's tangentFrame, written anew.
std::array<Vector, 2> tangentsOf(const Vector& n) {
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (abs(n(i)) < abs(n(axis))) axis = i;
  }
  const Digits square = n(0) * n(0) + n(1) * n(1) + n(2) * n(2);
  Vector t = n * Digits(-n(axis) / square);
  t(axis) += 1;
  t /= sqrt(Digits(t(0) * t(0) + t(1) * t(1) + t(2) * t(2)));
  Vector b{n(1) * t(2) - n(2) * t(1), n(2) * t(0) - n(0) * t(2), n(0) * t(1) - n(1) * t(0)};
  b /= sqrt(square);
  return {t, b};
}

}  // namespace

RegionValue differentiateRegions(const CutScene& scene, const Receiver& receiver, const Multiprecision& step) {
  const Vector x = withoutRounding(receiver.position);
  const Vector n = withoutRounding(receiver.normal);
  const auto irradianceOf = [&](const Vector& v) { return Digits(n(0) * v(0) + n(1) * v(1) + n(2) * v(2)); };
  const auto shifted = [&](int i, int di, int j, int dj) {
    Vector y = x;
    y(i) += step * di;
    y(j) += step * dj;
    return irradianceOf(scene.vectorIrradiance(y, n));
  };
  const Vector v = scene.vectorIrradiance(x, n);
  RegionValue value;
  value.irradiance = irradianceOf(v);
  value.rotational_gradient = {n(1) * v(2) - n(2) * v(1), n(2) * v(0) - n(0) * v(2), n(0) * v(1) - n(1) * v(0)};
  for (int i = 0; i < 3; ++i) {
    const Digits above = shifted(i, 1, i, 0);
    const Digits below = shifted(i, -1, i, 0);
    value.gradient(i) = (above - below) / (2 * step);
    value.hessian(i, i) = (above + below - 2 * value.irradiance) / (step * step);
    for (int j = 0; j < i; ++j) {
      const Digits same = shifted(i, 1, j, 1) + shifted(i, -1, j, -1);
      const Digits opposite = shifted(i, 1, j, -1) + shifted(i, -1, j, 1);
      value.hessian(i, j) = (same - opposite) / (4 * step * step);
      value.hessian(j, i) = value.hessian(i, j);
    }
  }
  const std::array<Vector, 2> tangents = tangentsOf(n);
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      Digits sum = 0;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) sum += tangents[a](i) * value.hessian(i, j) * tangents[b](j);
      }
      value.tangential_hessian(a, b) = sum;
    }
  }
  return value;
}

}  // namespace irradiff
