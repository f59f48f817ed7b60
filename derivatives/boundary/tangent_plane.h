#pragma once

#include "derivatives/boundary/irradiance.h"

namespace irradiff {

/// The receiver's tangent plane, in the frame of `tangentFrame(normal)`.
template <class Scalar>
class TangentPlane {
 public:
  explicit TangentPlane(const Vector3<Scalar>& normal)
      : frame_(tangentFrame(normal)), length_(norm(normal)), inverse_length_(lift<Scalar>(1.0) / length_) {}

  /// The components v.t and v.b of a vector from `turned` = n x v: v.t = (n x v).b/|n|, v.b = -(n x v).t/|n|. Those of
  /// a vector almost along the normal are as right as `turned` is; directly they would have the rounding of v.
  Vector2<Scalar> components(const Vector3<Scalar>& turned) const {
    return {dot(turned, bitangent()) * inverse_length_, -dot(turned, tangent()) * inverse_length_};
  }

  /// The components v.t and v.b, right to the rounding of v.
  Vector2<Scalar> projection(const Vector3<Scalar>& v) const { return {dot(v, tangent()), dot(v, bitangent())}; }

  /// n x v for a vector v of the given components.
  Vector3<Scalar> turned(const Vector2<Scalar>& components) const {
    Vector3<Scalar> result;
    for (int i = 0; i < 3; ++i) {
      result(i) = length_ * (components(0) * frame_(i, 1) - components(1) * frame_(i, 0));
    }
    return result;
  }

 private:
  Vector3<Scalar> tangent() const { return {frame_(0, 0), frame_(1, 0), frame_(2, 0)}; }
  Vector3<Scalar> bitangent() const { return {frame_(0, 1), frame_(1, 1), frame_(2, 1)}; }

  Eigen::Matrix<Scalar, 3, 2> frame_;
  Scalar length_;
  Scalar inverse_length_;
};

}  // namespace irradiff
