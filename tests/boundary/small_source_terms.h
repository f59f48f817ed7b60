#pragma once

#include "derivatives/boundary/tangent_plane.h"
#include "derivatives/boundary/vector.h"
#include "derivatives/flatland/segment_form.h"

#include <array>
#include <vector>

namespace irradiff {

/// A Gauss-Legendre rule at any scalar.
template <class Scalar>
struct Rule {
  std::vector<Scalar> nodes, weights;
};

/// The terms of a small source at any scalar: operation by operation what SmallSourceSums, areaRule and the length rule
/// of evaluateSegment do in double, which a test holds it to, bit by bit. Accumulator is the scalar of the sums over
/// nodes.
template <class Scalar, int Dimension, class Accumulator = Scalar>
struct SmallSourceTerms {
  using Vector = Eigen::Matrix<Scalar, Dimension, 1>;

  Accumulator irradiance = lift<Accumulator>(0.0);
  Eigen::Matrix<Accumulator, Dimension, 1> gradient =
      Eigen::Matrix<Accumulator, Dimension, 1>::Constant(lift<Accumulator>(0.0));
  Eigen::Matrix<Accumulator, Dimension, Dimension> hessian =
      Eigen::Matrix<Accumulator, Dimension, Dimension>::Constant(lift<Accumulator>(0.0));
  Eigen::Matrix<Accumulator, Dimension - 1, Dimension - 1> tangential_hessian =
      Eigen::Matrix<Accumulator, Dimension - 1, Dimension - 1>::Constant(lift<Accumulator>(0.0));
  Eigen::Matrix<Accumulator, Dimension - 1, 1> tangential_irradiance =
      Eigen::Matrix<Accumulator, Dimension - 1, 1>::Constant(lift<Accumulator>(0.0));
  Accumulator irradiance_size = lift<Accumulator>(0.0);
  Accumulator gradient_size = lift<Accumulator>(0.0);
  Accumulator hessian_size = lift<Accumulator>(0.0);
  Accumulator tangential_hessian_size = lift<Accumulator>(0.0);
  Accumulator tangential_irradiance_size = lift<Accumulator>(0.0);

  using Tangential = Eigen::Matrix<Scalar, Dimension - 1, 1>;
  struct InTangentPlane {
    Tangential components;
    Scalar size;
  };

  void add(const Vector& p, const InTangentPlane& p_tangential, const Scalar& height, const Scalar& offset,
           const Vector& area, const InTangentPlane& area_tangential, const Scalar& area_size, const Vector& normal) {
    using std::abs;
    using std::sqrt;
    const Scalar power = lift<Scalar>(Dimension + 1);
    const Scalar power_times_next = lift<Scalar>((Dimension + 1) * (Dimension + 3));
    const Scalar two = lift<Scalar>(2.0);
    const Scalar inverse_square = lift<Scalar>(1.0) / dot(p, p);
    const Scalar inverse = sqrt(inverse_square);
    const Scalar decay = Dimension == 3 ? Scalar(inverse_square * inverse_square) : Scalar(inverse_square * inverse);
    const Scalar kernel = height * offset;
    Vector slope;
    Vector w;
    for (int i = 0; i < Dimension; ++i) {
      slope(i) = offset * normal(i) + height * area(i);
      w(i) = p(i) * inverse_square;
    }
    irradiance = irradiance + Accumulator(Scalar(decay * kernel));
    for (int i = 0; i < Dimension; ++i) {
      gradient(i) = gradient(i) + Accumulator(Scalar(decay * (power * kernel * w(i) - slope(i))));
      for (int j = 0; j < Dimension; ++j) {
        Scalar entry = normal(i) * area(j) + area(i) * normal(j) - power * (slope(i) * w(j) + w(i) * slope(j)) +
                       power_times_next * kernel * w(i) * w(j);
        if (i == j) {
          entry = entry - power * kernel * inverse_square;
        }
        hessian(i, j) = hessian(i, j) + Accumulator(Scalar(decay * entry));
      }
    }
    const Tangential& a_t = area_tangential.components;
    Tangential w_t;
    for (int a = 0; a < Dimension - 1; ++a) {
      w_t(a) = p_tangential.components(a) * inverse_square;
    }
    for (int a = 0; a < Dimension - 1; ++a) {
      tangential_irradiance(a) =
          tangential_irradiance(a) + Accumulator(Scalar(decay * offset * p_tangential.components(a)));
      for (int b = 0; b < Dimension - 1; ++b) {
        Scalar entry = power_times_next * offset * w_t(a) * w_t(b) - power * (a_t(a) * w_t(b) + w_t(a) * a_t(b));
        if (a == b) {
          entry = entry - power * offset * inverse_square;
        }
        tangential_hessian(a, b) = tangential_hessian(a, b) + Accumulator(Scalar(decay * height * entry));
      }
    }
    tangential_irradiance_size =
        tangential_irradiance_size + Accumulator(Scalar(decay * abs(offset) * p_tangential.size));
    tangential_hessian_size =
        tangential_hessian_size +
        Accumulator(Scalar(decay * height *
                           (two * power * area_tangential.size * inverse +
                            lift<Scalar>((Dimension + 1) * (Dimension + 4)) * abs(offset) * inverse_square)));
    const Scalar slope_size = abs(offset) + height * area_size;
    irradiance_size = irradiance_size + Accumulator(Scalar(decay * abs(kernel)));
    gradient_size = gradient_size + Accumulator(Scalar(decay * (slope_size + power * abs(kernel) * inverse)));
    hessian_size =
        hessian_size +
        Accumulator(Scalar(decay * (two * area_size + two * power * slope_size * inverse +
                                    lift<Scalar>((Dimension + 1) * (Dimension + 4)) * abs(kernel) * inverse_square)));
  }
};

/// A triangle relative to the receiver and above the horizon.
template <class Scalar>
using Triangle = std::array<Vector3<Scalar>, 3>;

/// The part of derivatives/form_factor/area_rule.cpp that integrates one triangle of the fan.
template <class Scalar, class Accumulator = Scalar>
SmallSourceTerms<Scalar, 3, Accumulator> triangleTerms(const Triangle<Wide<Scalar>>& triangle,
                                                       const Vector3<Scalar>& normal, const Rule<Scalar>& rule) {
  using WideVector = Vector3<Wide<Scalar>>;
  const Scalar one = lift<Scalar>(1.0);
  const auto& [a, b, c] = triangle;
  const WideVector wide_normal = widen<Wide<Scalar>, Scalar, 3>(normal);
  const auto heightOf = [&wide_normal](const WideVector& r) { return static_cast<Scalar>(dot(wide_normal, r)); };
  const Scalar height_a = heightOf(a);
  const Scalar height_b = heightOf(b);
  const Scalar height_c = heightOf(c);
  const WideVector wide_area = cross<Wide<Scalar>>(difference(b, a), difference(c, a));
  const Vector3<Scalar> area = narrow<Scalar>(wide_area);
  const Scalar area_size = norm(area);
  const auto offset = static_cast<Scalar>(dot(wide_area, a));
  const Vector3<Scalar> pa = narrow<Scalar>(a);
  const Vector3<Scalar> ab = narrow<Scalar>(difference(b, a));
  const Vector3<Scalar> bc = narrow<Scalar>(difference(c, b));
  const TangentPlane<Scalar> plane(normal);
  SmallSourceTerms<Scalar, 3, Accumulator> sums;
  using InTangentPlane = typename SmallSourceTerms<Scalar, 3, Accumulator>::InTangentPlane;
  const auto inTangentPlane = [&](const WideVector& v) -> InTangentPlane {
    const Vector2<Scalar> components = plane.components(narrow<Scalar>(cross(wide_normal, v)));
    return {components, norm(components) + lift<Scalar>(0x1p-53) * norm(narrow<Scalar>(v))};
  };
  const InTangentPlane pa_t = inTangentPlane(a);
  const InTangentPlane ab_t = inTangentPlane(difference(b, a));
  const InTangentPlane bc_t = inTangentPlane(difference(c, b));
  const InTangentPlane area_t = inTangentPlane(wide_area);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const Scalar& s = rule.nodes[i];
    for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
      const Scalar& t = rule.nodes[j];
      const Scalar weight = rule.weights[i] * rule.weights[j] * s;
      Vector3<Scalar> p;
      for (int k = 0; k < 3; ++k) {
        p(k) = pa(k) + s * (ab(k) + t * bc(k));
      }
      const Scalar height = (one - s) * height_a + s * ((one - t) * height_b + t * height_c);
      InTangentPlane p_t;
      for (int k = 0; k < 2; ++k) {
        p_t.components(k) = pa_t.components(k) + s * (ab_t.components(k) + t * bc_t.components(k));
      }
      p_t.size = pa_t.size + s * (ab_t.size + t * bc_t.size);
      sums.add(p, p_t, height, weight * offset, scaled(area, weight),
               {scaled(area_t.components, weight), weight * area_t.size}, weight * area_size, normal);
    }
  }
  return sums;
}

/// The length rule of derivatives/flatland/segment_evaluation.cpp for a segment above the horizon.
template <class Scalar, class Accumulator = Scalar>
SmallSourceTerms<Scalar, 2, Accumulator> segmentTerms(const ClippedSegment<Scalar>& segment,
                                                      const Vector2<Scalar>& normal, const Rule<Scalar>& rule) {
  const Scalar one = lift<Scalar>(1.0);
  const Vector2<Wide<Scalar>> wide_edge = difference(segment.last, segment.first);
  const Vector2<Scalar> edge = narrow<Scalar>(wide_edge);
  const Vector2<Scalar> r = narrow<Scalar>(segment.first);
  const Vector2<Scalar> element(edge(1), -edge(0));
  const auto offset = static_cast<Scalar>(cross(segment.first, wide_edge));
  SmallSourceTerms<Scalar, 2, Accumulator> sums;
  using Terms = SmallSourceTerms<Scalar, 2, Accumulator>;
  const Scalar inverse_length = one / norm(normal);
  const Scalar r_t = alongTangent<Scalar>(segment.first, normal);
  const Scalar edge_t = alongTangent<Scalar>(wide_edge, normal);
  const Scalar element_t = -static_cast<Scalar>(dot(widen<Wide<Scalar>, Scalar, 2>(normal), wide_edge));
  const Scalar slack = lift<Scalar>(kWideSlack);
  using std::abs;
  const Scalar r_size = abs(r_t) + slack * norm(r);
  const Scalar edge_size = abs(edge_t) + slack * norm(edge);
  const Scalar element_size = abs(element_t) + slack * norm(edge);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const Scalar& t = rule.nodes[i];
    const Scalar& weight = rule.weights[i];
    Vector2<Scalar> p;
    for (int k = 0; k < 2; ++k) {
      p(k) = r(k) + t * edge(k);
    }
    const Scalar height = (one - t) * segment.first_height + t * segment.last_height;
    sums.add(p, {typename Terms::Tangential(Scalar((r_t + t * edge_t) * inverse_length)), r_size + t * edge_size},
             height, weight * offset, scaled(element, weight),
             {typename Terms::Tangential(Scalar(weight * element_t * inverse_length)), weight * element_size},
             weight * norm(element), normal);
  }
  return sums;
}

}  // namespace irradiff
