#pragma once

#include <array>
#include <cmath>

namespace irradiff {

/// What a point of the scene, relative to the receiver in the receiver's frame, contributes to integrals along boundary
/// points: with x along the tangent, h along the normal, rho the distance,
///   S = -x/rho      irradiance: E = L (S_last - S_first) for a wall of radiance L
///   S_t = h^2/rho^3, S_n = -x h/rho^3     its gradient when the receiver moves along tangent and normal
///   S_tt = 3 h^2 x/rho^5                  its second derivative along the tangent
///   C = h/rho       rotation: dE/dalpha = -L (C_last - C_first), alpha counterclockwise
/// docs/derivations/flatland_bounce.md, section 1. On the horizon S is -1 or 1 and all others are 0.
enum SightTerm { kSight, kSightAlong, kSightAcross, kSightCurvature, kSightTurn, kSightTerms };

template <class Scalar>
using SightTermsOf = std::array<Scalar, kSightTerms>;
using SightTerms = SightTermsOf<double>;

template <class Scalar>
SightTermsOf<Scalar> sightTerms(const Scalar& x, const Scalar& h) {
  using std::sqrt;
  const Scalar inverse = Scalar(1.0) / sqrt(x * x + h * h);
  const Scalar sine = -x * inverse;
  const Scalar cosine = h * inverse;
  return {sine, cosine * cosine * inverse, sine * cosine * inverse,
          Scalar(-3.0) * cosine * cosine * sine * inverse * inverse, cosine};
}

/// Of the counterclockwise end of the horizon; of the clockwise one it is the negative.
inline constexpr SightTerms kHorizonTerms{1.0, 0.0, 0.0, 0.0, 0.0};

}  // namespace irradiff
