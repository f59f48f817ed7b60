#pragma once

#include "derivatives/boundary/arc_moments.h"
#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/vector.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

namespace irradiff {

/// How many terms of the moments' series are summed: for each of these there is a loop without a branch.
inline constexpr std::array<std::size_t, 5> kSeriesLengths = {3, 5, 8, 12, detail::kArcSeriesTerms};

/// The bins of the angle in [0, 1] for which a length is chosen.
inline constexpr std::size_t kAngleBins = 8;

namespace detail {

/// What a series of positive terms loses beyond `terms`, relative to its first term, for angles up to `angle`.
constexpr long double seriesRemainder(const ArcSeries<long double, kArcSeriesTerms>& series, std::size_t terms,
                                      long double angle) {
  long double power = 1.0L;
  long double rest = 0.0L;
  for (std::size_t k = 0; k < kArcSeriesTerms; ++k) {
    rest += k >= terms ? series[k] * power : 0.0L;
    power *= angle * angle;
  }
  return rest / series[0];
}

constexpr long double seriesRemainder(std::size_t terms, long double angle) {
  long double largest = 0.0L;
  for (const ArcSeries<long double, kArcSeriesTerms>* series :
       {&kArcMomentSeries.aa, &kArcMomentSeries.ab, &kArcMomentSeries.aaaa, &kArcMomentSeries.aaab,
        &kArcMomentSeries.aabb}) {
    largest = std::max(largest, seriesRemainder(*series, terms, angle));
  }
  return largest;
}

}  // namespace detail

/// For each bin of the angle the shortest series whose relative error is at most `truncation`: indices into
/// kSeriesLengths. The longest one counts as exact.
constexpr std::array<std::size_t, kAngleBins> seriesLengthsFor(long double truncation) {
  std::array<std::size_t, kAngleBins> lengths{};
  for (std::size_t bin = 0; bin < kAngleBins; ++bin) {
    const long double angle = static_cast<long double>(bin + 1) / kAngleBins;
    while (lengths[bin] + 1 < kSeriesLengths.size() &&
           detail::seriesRemainder(kSeriesLengths[lengths[bin]], angle) > truncation) {
      ++lengths[bin];
    }
  }
  return lengths;
}

/// One end of an arc in plain arithmetic, in metres.
template <class Scalar>
struct PlainEnd {
  Vector3<Scalar> position;
  Scalar inverse_distance;
  Scalar cosine;  ///< height times inverse distance; 0 where the arc was cut at the horizon
  Scalar height;
};

/// A straight edge, or what is seen of it, in plain arithmetic.
template <class Scalar>
struct PlainEdge {
  PlainEnd<Scalar> first, last;
  Vector3<Scalar> edge;    ///< e = last - first, right to u in each component
  Scalar length;           ///< |e|
  Vector3<Scalar> moment;  ///< r x e
  Scalar area;             ///< |r x e|
};

/// Relative errors in units of u, beside those that the arithmetic of arcs makes.
struct PlainEdgeErrors {
  double moment;  ///< of r x e, beyond a rounding of its components
  double height;  ///< of the heights of the ends
  double cut;     ///< of the length of what is seen of an edge, where the horizon cuts it
};

/// Errors of an arc in units of u beside those of r x e, and how they enter (docs/derivations/rule_choice.md, section
/// 2).
inline constexpr double kPlainAngleError = 20.0;
inline constexpr double kPlainArcError = 64.0;
inline constexpr double kMomentToAngle = 2.0;
inline constexpr double kMomentToArc = 3.0;
inline constexpr double kMomentToCutArc = 8.0;

/// Sums over arcs in plain arithmetic: the vector irradiance times two, the gradient, the Hessian before it is made
/// symmetric; the sizes of what was added up; and those sizes times each arc's own error in units of u.
template <class Scalar>
struct PlainSums {
  Vector3<Scalar> angle_vector = Vector3<Scalar>::Constant(lift<Scalar>(0.0));
  Vector3<Scalar> gradient = angle_vector;
  Matrix3<Scalar> hessian = Matrix3<Scalar>::Constant(lift<Scalar>(0.0));
  Scalar angle_size = lift<Scalar>(0.0);
  Scalar gradient_size = lift<Scalar>(0.0);
  Scalar hessian_size = lift<Scalar>(0.0);
  Scalar angle_error = lift<Scalar>(0.0);
  Scalar gradient_error = lift<Scalar>(0.0);
  Scalar hessian_error = lift<Scalar>(0.0);
  std::size_t arcs = 0;
};

/// Moments with a bound of what cutting their series short made them too small by, relative to each.
template <class Scalar>
struct TruncatedMoments {
  ArcMoments<Scalar> mean;
  Scalar truncation;
};

namespace detail {

/// The first kTerms terms at x, even and odd ones apart: two short chains of operations in place of a long one.
template <std::size_t kTerms, class Scalar>
Scalar splitSeriesValue(const ArcSeries<long double, kArcSeriesTerms>& series, const Scalar& x,
                        const Scalar& x_square) {
  constexpr std::size_t kLastEven = (kTerms - 1) / 2 * 2;
  constexpr std::size_t kLastOdd = (kTerms - 2) / 2 * 2 + 1;
  const auto coefficient = [&series](std::size_t k) { return lift<Scalar>(static_cast<double>(series[k])); };
  Scalar even = coefficient(kLastEven);
  for (std::size_t k = kLastEven; k >= 2; k -= 2) {
    even = even * x_square + coefficient(k - 2);
  }
  Scalar odd = coefficient(kLastOdd);
  for (std::size_t k = kLastOdd; k >= 3; k -= 2) {
    odd = odd * x_square + coefficient(k - 2);
  }
  return even + x * odd;
}

template <std::size_t kTerms, class Scalar>
TruncatedMoments<Scalar> truncatedMoments(const Scalar& square) {
  const auto& series = kArcMomentSeries;
  const Scalar fourth = square * square;
  TruncatedMoments<Scalar> moments{
      {splitSeriesValue<kTerms>(series.aa, square, fourth), splitSeriesValue<kTerms>(series.ab, square, fourth),
       splitSeriesValue<kTerms>(series.aaaa, square, fourth), splitSeriesValue<kTerms>(series.aaab, square, fourth),
       splitSeriesValue<kTerms>(series.aabb, square, fourth)},
      lift<Scalar>(0.0)};
  if constexpr (kTerms < kArcSeriesTerms) {
    // The coefficients are positive: from angle 1 down the remainder falls at least like its first term.
    constexpr auto kAtOne = static_cast<double>(seriesRemainder(kTerms, 1.0L));
    Scalar power = square;
    for (std::size_t k = 1; k < kTerms; ++k) {
      power = power * square;
    }
    moments.truncation = lift<Scalar>(kAtOne) * power;
  }
  return moments;
}

template <class Scalar>
std::size_t angleBin(const Scalar& angle) {
  if constexpr (std::is_floating_point_v<Scalar>) {
    return std::min(static_cast<std::size_t>(angle * static_cast<double>(kAngleBins)), kAngleBins - 1);
  } else {
    std::size_t bin = 0;
    while (bin + 1 < kAngleBins && !(angle < lift<Scalar>(static_cast<double>(bin + 1) / kAngleBins))) {
      ++bin;
    }
    return bin;
  }
}

template <class Scalar>
TruncatedMoments<Scalar> truncatedMoments(const Scalar& angle, const std::array<std::size_t, kAngleBins>& lengths) {
  const Scalar square = angle * angle;
  switch (lengths[angleBin(angle)]) {
    case 0:
      return truncatedMoments<kSeriesLengths[0]>(square);
    case 1:
      return truncatedMoments<kSeriesLengths[1]>(square);
    case 2:
      return truncatedMoments<kSeriesLengths[2]>(square);
    case 3:
      return truncatedMoments<kSeriesLengths[3]>(square);
    default:
      return truncatedMoments<kSeriesLengths[4]>(square);
  }
}

}  // namespace detail

/// The moments of an arc of at most two radians, by doubling above one, from series of the lengths named.
template <class Scalar>
TruncatedMoments<Scalar> plainMoments(const Scalar& angle, const std::array<std::size_t, kAngleBins>& lengths) {
  if (angle > lift<Scalar>(1.0)) {
    const Scalar half = angle * lift<Scalar>(0.5);
    const TruncatedMoments<Scalar> moments = detail::truncatedMoments(half, lengths);
    return {doubled(moments.mean, half), moments.truncation};
  }
  return detail::truncatedMoments(angle, lengths);
}

// Adds an arc of `angle` radians, at most 2, of the edge, from `first` to `last`. The edge kernel of
// derivatives/boundary/edge_kernel.h without unit vectors: with b = r x e and g = angle/|b|
//   2 V: b g,   gradient: b g <nu kappa>,   Hessian: [e]_x g <nu kappa> + b g (4 <nu kappa^2 w> - n <kappa^2>)^T,
// <..> the mean over the arc, from the values at the ends and ArcMoments.
template <class Scalar>
void addPlainArc(const PlainEdge<Scalar>& edge, const PlainEnd<Scalar>& first, const PlainEnd<Scalar>& last,
                 const Scalar& angle, const Scalar& angle_over_moment,
                 const std::array<std::size_t, kAngleBins>& lengths, const Vector3<Scalar>& normal, double angle_error,
                 double arc_error, PlainSums<Scalar>& sums) {
  const TruncatedMoments<Scalar> moments = plainMoments(angle, lengths);
  const ArcMoments<Scalar>& mean = moments.mean;
  const Scalar& nu0 = first.cosine;
  const Scalar& nu1 = last.cosine;
  const Scalar& kappa0 = first.inverse_distance;
  const Scalar& kappa1 = last.inverse_distance;
  const Scalar four = lift<Scalar>(4.0);
  const Scalar kappa00 = kappa0 * kappa0;
  const Scalar kappa01 = lift<Scalar>(2.0) * kappa0 * kappa1;
  const Scalar kappa11 = kappa1 * kappa1;
  const Scalar c0 = nu0 * kappa00;
  const Scalar c1 = nu0 * kappa01 + nu1 * kappa00;
  const Scalar c2 = nu0 * kappa11 + nu1 * kappa01;
  const Scalar c3 = nu1 * kappa11;
  const Scalar mean_nu_kappa = (nu0 * kappa0 + nu1 * kappa1) * mean.aa + (nu0 * kappa1 + nu1 * kappa0) * mean.ab;
  const Scalar mean_kappa2 = (kappa00 + kappa11) * mean.aa + kappa01 * mean.ab;
  const Scalar along_first = four * (c0 * mean.aaaa + c1 * mean.aaab + c2 * mean.aabb + c3 * mean.aaab);
  const Scalar along_last = four * (c0 * mean.aaab + c1 * mean.aabb + c2 * mean.aaab + c3 * mean.aaaa);
  const Vector3<Scalar> turn = scaled(edge.moment, angle_over_moment);
  const Scalar weight_first = along_first * kappa0;
  const Scalar weight_last = along_last * kappa1;
  const Scalar line_weight = angle_over_moment * mean_nu_kappa;
  const Vector3<Scalar> line = scaled(edge.edge, line_weight);
  for (int j = 0; j < 3; ++j) {
    const Scalar row = weight_first * first.position(j) + weight_last * last.position(j) - mean_kappa2 * normal(j);
    sums.angle_vector(j) = sums.angle_vector(j) + turn(j);
    sums.gradient(j) = sums.gradient(j) + turn(j) * mean_nu_kappa;
    for (int i = 0; i < 3; ++i) {
      sums.hessian(i, j) = sums.hessian(i, j) + turn(i) * row;
    }
  }
  sums.hessian(0, 1) = sums.hessian(0, 1) - line(2);
  sums.hessian(0, 2) = sums.hessian(0, 2) + line(1);
  sums.hessian(1, 0) = sums.hessian(1, 0) + line(2);
  sums.hessian(1, 2) = sums.hessian(1, 2) - line(0);
  sums.hessian(2, 0) = sums.hessian(2, 0) - line(1);
  sums.hessian(2, 1) = sums.hessian(2, 1) + line(0);
  const Scalar gradient_size = angle * mean_nu_kappa;
  const Scalar hessian_size = edge.length * line_weight + angle * (along_first + along_last + mean_kappa2);
  const Scalar error = lift<Scalar>(arc_error) + moments.truncation * lift<Scalar>(0x1p53);
  sums.angle_size = sums.angle_size + angle;
  sums.gradient_size = sums.gradient_size + gradient_size;
  sums.hessian_size = sums.hessian_size + hessian_size;
  sums.angle_error = sums.angle_error + angle * lift<Scalar>(angle_error);
  sums.gradient_error = sums.gradient_error + error * gradient_size;
  sums.hessian_error = sums.hessian_error + error * hessian_size;
  ++sums.arcs;
}

/// Adds the arc of an edge above the horizon, or its two parts if it is longer than kLongestArc (edge_arcs.h). Requires
/// that the receiver is not on the edge's line, within the error of the moment.
template <class Scalar>
void addPlainEdge(const PlainEdge<Scalar>& edge, const PlainEdgeErrors& errors,
                  const std::array<std::size_t, kAngleBins>& lengths, const Vector3<Scalar>& normal,
                  PlainSums<Scalar>& sums) {
  using std::atan2;
  const PlainEnd<Scalar>& first = edge.first;
  const PlainEnd<Scalar>& last = edge.last;
  const Scalar cosine_product = dot(first.position, last.position);
  const Scalar angle = atan2(edge.area, cosine_product);
  const double angle_error = kPlainAngleError + kMomentToAngle * errors.moment;
  const double arc_error = kPlainArcError + errors.height + errors.cut;
  if (!(angle > lift<Scalar>(kLongestArc))) {
    // As in angleOverFootDistance (edge_arcs.h).
    const Scalar over_moment =
        edge.area > cosine_product * lift<Scalar>(0x1p-32) ? angle / edge.area : lift<Scalar>(1.0) / cosine_product;
    addPlainArc(edge, first, last, angle, over_moment, lengths, normal, angle_error,
                arc_error + kMomentToArc * errors.moment, sums);
    return;
  }
  const Scalar one = lift<Scalar>(1.0);
  const Vector3<Scalar> along = scaled(edge.edge, Scalar(one / edge.length));
  const Scalar foot_distance = edge.area / edge.length;
  const Scalar before = -dot(first.position, along);
  const Scalar after = dot(last.position, along);
  const Scalar inverse = one / foot_distance;
  const Scalar foot_height = (after * first.height + before * last.height) / edge.length;
  const Vector3<Scalar> foot_position =
      scaled(cross(along, scaled(edge.moment, Scalar(one / edge.area))), foot_distance);
  const PlainEnd<Scalar> foot{foot_position, inverse, foot_height * inverse, foot_height};
  const Scalar first_angle = atan2(before, foot_distance);
  const Scalar last_angle = atan2(after, foot_distance);
  const double cut_arc_error = arc_error + kMomentToCutArc * errors.moment;
  addPlainArc(edge, first, foot, first_angle, Scalar(first_angle / edge.area), lengths, normal, angle_error,
              cut_arc_error, sums);
  addPlainArc(edge, foot, last, last_angle, Scalar(last_angle / edge.area), lengths, normal, angle_error, cut_arc_error,
              sums);
}

}  // namespace irradiff
