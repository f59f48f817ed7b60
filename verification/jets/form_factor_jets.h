#pragma once

#include "derivatives/form_factor/form_factor.h"

#include <Eigen/Core>
#include <ceres/jet.h>

#include <vector>

namespace irradiff {

/// A value with its derivatives with respect to the three coordinates of the receiver's position.
template <class Base>
using Jet = ceres::Jet<Base, 3>;

/// A value with first and second derivatives: a Jet of Jets.
template <class Base>
using SecondOrderJet = ceres::Jet<ceres::Jet<Base, 3>, 3>;

/// Derivatives of a templated form factor by automatic differentiation.
///
/// `formula` is a callable with a template operator()(std::span<const Vector3<T>> vertices, const Vector3<T>& position,
/// const Vector3<T>& normal) that returns the form factor as a T. The result is exact but for the rounding of Base: it
/// catches wrong derivative algebra, and trusts F. Requires that the formula is differentiable at the receiver.
template <class Base, class Formula>
FormFactor<Base> differentiateTwice(const Formula& formula, const std::vector<Vector3<Base>>& vertices,
                                    const Vector3<Base>& position, const Vector3<Base>& normal) {
  using T = SecondOrderJet<Base>;
  const auto constant = [](const Base& value) { return T(Jet<Base>(value)); };
  std::vector<Vector3<T>> jet_vertices;
  jet_vertices.reserve(vertices.size());
  for (const Vector3<Base>& v : vertices) {
    jet_vertices.push_back({constant(v(0)), constant(v(1)), constant(v(2))});
  }
  Vector3<T> jet_position;
  Vector3<T> jet_normal;
  for (int i = 0; i < 3; ++i) {
    jet_position(i) = T(Jet<Base>(position(i), i));
    jet_position(i).v[i] = Jet<Base>(lift<Base>(1.0));
    jet_normal(i) = constant(normal(i));
  }
  const T f = formula(std::span<const Vector3<T>>(jet_vertices), jet_position, jet_normal);
  FormFactor<Base> result;
  result.value = f.a.a;
  for (int i = 0; i < 3; ++i) {
    result.gradient(i) = f.v[i].a;
    for (int j = 0; j < 3; ++j) {
      result.hessian(i, j) = f.v[i].v[j];
    }
  }
  return result;
}

/// First derivatives of a templated gradient: the Hessian, one order of automatic differentiation above a formula for
/// the gradient. `formula` is as above but returns the gradient as a Vector3<T>.
template <class Base, class Formula>
Matrix3<Base> differentiateGradient(const Formula& formula, const std::vector<Vector3<Base>>& vertices,
                                    const Vector3<Base>& position, const Vector3<Base>& normal) {
  using T = Jet<Base>;
  std::vector<Vector3<T>> jet_vertices;
  jet_vertices.reserve(vertices.size());
  for (const Vector3<Base>& v : vertices) {
    jet_vertices.push_back({T(v(0)), T(v(1)), T(v(2))});
  }
  Vector3<T> jet_position;
  Vector3<T> jet_normal;
  for (int i = 0; i < 3; ++i) {
    jet_position(i) = T(position(i), i);
    jet_normal(i) = T(normal(i));
  }
  const Vector3<T> gradient = formula(std::span<const Vector3<T>>(jet_vertices), jet_position, jet_normal);
  Matrix3<Base> hessian;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      hessian(i, j) = gradient(i).v[j];
    }
  }
  return hessian;
}

/// First derivatives of a templated form factor with respect to the normal, which is taken as any vector: its cross
/// product with the normal in front is the rotational gradient. `formula` as in differentiateTwice.
template <class Base, class Formula>
Vector3<Base> differentiateByNormal(const Formula& formula, const std::vector<Vector3<Base>>& vertices,
                                    const Vector3<Base>& position, const Vector3<Base>& normal) {
  using T = Jet<Base>;
  std::vector<Vector3<T>> jet_vertices;
  for (const Vector3<Base>& v : vertices) {
    jet_vertices.push_back({T(v(0)), T(v(1)), T(v(2))});
  }
  Vector3<T> jet_position;
  Vector3<T> jet_normal;
  for (int i = 0; i < 3; ++i) {
    jet_position(i) = T(position(i));
    jet_normal(i) = T(normal(i), i);
  }
  const T f = formula(std::span<const Vector3<T>>(jet_vertices), jet_position, jet_normal);
  return {f.v[0], f.v[1], f.v[2]};
}

}  // namespace irradiff
