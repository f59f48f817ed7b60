#pragma once

#include <Eigen/Core>
#include <boost/multiprecision/gmp.hpp>

#include <array>

namespace irradiff {

/// Without expression templates, so that every expression is a number.
using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
using RationalVector = std::array<Rational, 3>;

/// The doubles themselves, not the decimals they are written as.
inline RationalVector rational(const Eigen::Vector3d& v) { return {Rational(v.x()), Rational(v.y()), Rational(v.z())}; }

inline RationalVector operator-(const RationalVector& a, const RationalVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline RationalVector operator+(const RationalVector& a, const RationalVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline RationalVector operator*(const Rational& factor, const RationalVector& v) {
  return {factor * v[0], factor * v[1], factor * v[2]};
}
inline Rational dot(const RationalVector& a, const RationalVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline RationalVector cross(const RationalVector& a, const RationalVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline bool isZero(const RationalVector& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

using RationalMatrix = std::array<RationalVector, 3>;

/// The component that is not 0 and comes first. Requires one.
inline const Rational& leading(const RationalVector& v) { return v[0] != 0 ? v[0] : v[1] != 0 ? v[1] : v[2]; }
/// One vector for all that lie on a line through the origin.
inline RationalVector withoutScale(const RationalVector& v) { return (1 / leading(v)) * v; }
/// One vector for all that have the same direction.
inline RationalVector withoutLength(const RationalVector& v) { return (1 / abs(leading(v))) * v; }

}  // namespace irradiff
