#include "verification/enclosure/contour_integral.h"

#include "verification/enclosure/arctangent_quotient.h"
#include "verification/enclosure/central_difference.h"
#include "verification/enclosure/horizon_clip.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace irradiff {

using namespace enclosure;

namespace {

/// n.(r x r') times angle / |r x r'|.
Ball contourTerm(const BallVector& r, const BallVector& s, const BallVector& normal) {
  const BallVector c = cross<Ball>(r, s);
  const Ball sine_squared = dot(c, c);
  const Ball cosine = dot(r, s);
  Ball angle_over_sine;
  if (cosine > Ball(0) && Ball(4) * sine_squared < cosine * cosine) {
    // Small angles, and the receiver on the edge's line: sine_squared may be exactly zero.
    angle_over_sine = arctangentQuotient(sine_squared / (cosine * cosine))[0] / cosine;
  } else {
    const Ball sine = sqrt(sine_squared);
    angle_over_sine = atan2(sine, cosine) / sine;
  }
  return dot(normal, c) * angle_over_sine;
}

Ball contourFormFactor(const std::vector<BallVector>& vertices, const BallVector& position, const BallVector& normal) {
  Ball sum;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    const std::vector<BallVector> triangle{vertices[0] - position, vertices[i] - position, vertices[i + 1] - position};
    const std::vector<BallVector> visible = aboveHorizon<Ball, 3>(triangle, normal, true);
    for (std::size_t k = 0; k < visible.size(); ++k) {
      sum += contourTerm(visible[k], visible[(k + 1) % visible.size()], normal);
    }
  }
  return sum / (Ball(2) * Ball::pi());
}

}  // namespace

FormFactorEnclosure differenceContour(const Polygon& polygon, const Receiver& receiver) {
  const WorkingPrecision scope(precisionForDigits(300));
  std::vector<BallVector> vertices;
  for (const Eigen::Vector3d& vertex : polygon.vertices) vertices.push_back(exactly(vertex));
  const BallVector position = exactly(receiver.position);
  const BallVector normal = exactly(receiver.normal);
  const DifferenceQuotients<3> quotients = differenceTwice<3>(
      [&](const BallVector& displacement) { return contourFormFactor(vertices, position + displacement, normal); },
      smoothLength<3>(polygon.vertices, receiver));
  double farthest = 0.0;
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    farthest = std::max(farthest, (vertex - receiver.position).cwiseAbs().maxCoeff());
  }
  const DifferenceQuotients<3> over_normal = differenceTwice<3>(
      [&](const BallVector& displacement) { return contourFormFactor(vertices, position, normal + displacement); },
      smoothLength<3>(polygon.vertices, receiver) / farthest);
  return {quotients.value, quotients.gradient, quotients.hessian, over_normal.gradient};
}

}  // namespace irradiff
