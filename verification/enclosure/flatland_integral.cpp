#include "verification/enclosure/flatland_integral.h"

#include "verification/enclosure/ball_vector.h"
#include "verification/enclosure/central_difference.h"
#include "verification/enclosure/form_factor_enclosure.h"
#include "verification/enclosure/horizon_clip.h"
#include "verification/enclosure/second_order_taylor.h"
#include "verification/enclosure/validated_integral.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {

using namespace enclosure;

namespace {

using Taylor = SecondOrderTaylor<Ball, 2>;
using TaylorVector = Eigen::Matrix<Taylor, 2, 1>;
using BallVector2 = Eigen::Matrix<Ball, 2, 1>;

TaylorVector constant(const Eigen::Vector2d& v) { return {Taylor(Ball(v(0))), Taylor(Ball(v(1)))}; }

TaylorVector variable(const Eigen::Vector2d& v) {
  return {Taylor::variable(Ball(v(0)), 0), Taylor::variable(Ball(v(1)), 1)};
}

template <class Scalar>
Scalar cross2(const Eigen::Matrix<Scalar, 2, 1>& a, const Eigen::Matrix<Scalar, 2, 1>& b) {
  return a(0) * b(1) - a(1) * b(0);
}

/// (n.p) |p|^-3 at p = r + t e, t in [0, 1].
class SegmentIntegrand {
 public:
  SegmentIntegrand(const TaylorVector& r, const TaylorVector& e, const TaylorVector& normal)
      : square_{dot(r, r), dot(r, e) * Ball(2), dot(e, e)}, height_{dot(normal, r), dot(normal, e)} {}

  template <class S>
  std::array<S, Taylor::kTerms> evaluate(const Ball& center, const S& offset) const {
    using Local = SecondOrderTaylor<S, 2>;
    const Taylor at_center = square_[0] + (square_[1] + square_[2] * center) * center;
    const Taylor slope = square_[1] + square_[2] * (Ball(2) * center);
    const Local square = at_center.cast<S>() + (slope.cast<S>() + square_[2].template cast<S>() * offset) * offset;
    const Local height = (height_[0] + height_[1] * center).cast<S>() + height_[1].template cast<S>() * offset;
    const S inverse_square = S(1.0) / square.value;
    const S power = sqrt(inverse_square) * inverse_square;  // |p|^-3
    const S first = S(-1.5) * power * inverse_square;
    const S second = S(-2.5) * first * inverse_square;
    return (height * compose(square, power, first, second)).terms();
  }

 private:
  std::array<Taylor, 3> square_;
  std::array<Taylor, 2> height_;
};

/// The irradiance of the part of a segment above the horizon, from its ends relative to the receiver.
Taylor irradianceOf(const std::vector<TaylorVector>& ends, const TaylorVector& normal, const std::string& name) {
  const std::vector<TaylorVector> visible = aboveHorizon<Taylor, 2>(ends, normal, false);
  if (visible.size() != 2) return {};
  const TaylorVector e = visible[1] - visible[0];
  // |N.p| dl = |r x e| dt, the same for every t.
  Taylor weight = cross2<Taylor>(visible[0], e);
  if (weight.value.containsZero()) throw std::domain_error("segment \"" + name + "\": the receiver is on its line");
  if (weight.value < Ball(0)) weight = -weight;
  const auto terms = integrateUnitInterval<Taylor::kTerms>(SegmentIntegrand(visible[0], e, normal));
  Taylor irradiance(terms[0]);
  irradiance.gradient = {terms[1], terms[2]};
  irradiance.hessian = {terms[3], terms[4], terms[5]};
  return irradiance * weight;
}

BallVector2 exactly2(const Eigen::Vector2d& v) { return {Ball(v(0)), Ball(v(1))}; }

}  // namespace

FlatlandEnclosure encloseFlatland(const Segment& segment, const FlatlandReceiver& receiver, int digits) {
  const slong first_precision = precisionForDigits(2 * digits);
  for (slong precision = first_precision; precision <= 16 * first_precision; precision *= 2) {
    const WorkingPrecision scope(precision);
    const auto relativeTo = [&](const TaylorVector& position) {
      std::vector<TaylorVector> ends(2);
      for (std::size_t i = 0; i < 2; ++i) {
        for (Eigen::Index k = 0; k < 2; ++k) ends[i](k) = Taylor(Ball(segment.vertices[i](k))) - position(k);
      }
      return ends;
    };
    const Taylor irradiance =
        irradianceOf(relativeTo(variable(receiver.position)), constant(receiver.normal), segment.name);
    const Taylor over_normal =
        irradianceOf(relativeTo(constant(receiver.position)), variable(receiver.normal), segment.name);
    FlatlandEnclosure result;
    result.value = irradiance.value;
    result.gradient << irradiance.gradient[0], irradiance.gradient[1];
    result.normal_gradient << over_normal.gradient[0], over_normal.gradient[1];
    result.hessian << irradiance.hessian[0], irradiance.hessian[1], irradiance.hessian[1], irradiance.hessian[2];
    if (correctDigits(result) >= digits) return result;
  }
  throw std::runtime_error("segment \"" + segment.name + "\": " + std::to_string(digits) +
                           " digits are not reached at " + std::to_string(16 * first_precision) +
                           " bits; the receiver is too near its end, or sees none of it");
}

FlatlandEnclosure differenceFlatland(const Segment& segment, const FlatlandReceiver& receiver) {
  const WorkingPrecision scope(precisionForDigits(300));
  const BallVector2 normal = exactly2(receiver.normal);
  const auto irradiance = [&](const BallVector2& position, const BallVector2& n) -> Ball {
    const std::vector<BallVector2> visible = aboveHorizon<Ball, 2>(
        {exactly2(segment.vertices[0]) - position, exactly2(segment.vertices[1]) - position}, n, false);
    if (visible.empty()) return {};
    // n.w dphi = d(n x w) for a unit vector w that turns by dphi.
    const auto sine = [&](const BallVector2& p) { return cross2<Ball>(n, p) / sqrt(dot(p, p)); };
    return abs(sine(visible[1]) - sine(visible[0]));
  };
  const BallVector2 position = exactly2(receiver.position);
  const double length = smoothLength<2>({segment.vertices[0], segment.vertices[1]}, receiver);
  const double farthest = std::max((segment.vertices[0] - receiver.position).cwiseAbs().maxCoeff(),
                                   (segment.vertices[1] - receiver.position).cwiseAbs().maxCoeff());
  const DifferenceQuotients<2> quotients = differenceTwice<2>(
      [&](const BallVector2& displacement) { return irradiance(position + displacement, normal); }, length);
  const DifferenceQuotients<2> over_normal = differenceTwice<2>(
      [&](const BallVector2& displacement) { return irradiance(position, normal + displacement); }, length / farthest);
  return {quotients.value, quotients.gradient, quotients.hessian, over_normal.gradient};
}

double correctDigits(const FlatlandEnclosure& enclosure) {
  return std::min({normwiseDigits(Eigen::Matrix<Ball, 1, 1>(enclosure.value)), normwiseDigits(enclosure.gradient),
                   normwiseDigits(enclosure.hessian), normwiseDigits(enclosure.normal_gradient)});
}

}  // namespace irradiff
