#pragma once

#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"
#include "verification/enclosure/ball.h"

namespace irradiff {

/// Flatland irradiance E of a segment of radiance 1 (W/m), its gradient (W/m^2) and its Hessian (W/m^3) with respect to
/// the receiver's position, and its gradient with respect to n (W/m), taken as any vector.
struct FlatlandEnclosure {
  Ball value;
  Eigen::Matrix<Ball, 2, 1> gradient;
  Eigen::Matrix<Ball, 2, 2> hessian;
  Eigen::Matrix<Ball, 2, 1> normal_gradient;
};

/// Encloses the defining line integral
///   E = integral over the segment of max(0, n.p) |N.p| / |p|^3 dl,   p = y - x,
/// by validated quadrature, its derivatives by differentiating under it, the motion of the cut at the horizon included.
/// The sides of the segment shine alike, so that E >= 0 whatever the vertex order. Same digits and errors as
/// enclosePolar(); a receiver on the segment's line is rejected with std::domain_error: E has a kink there, or vanishes
/// with it.
FlatlandEnclosure encloseFlatland(const Segment& segment, const FlatlandReceiver& receiver, int digits);

/// The same by E = n.(difference of the unit vectors towards the ends, turned by a right angle), the closed form of the
/// integral, differenced as in differenceContour(). An estimate, as there.
FlatlandEnclosure differenceFlatland(const Segment& segment, const FlatlandReceiver& receiver);

/// Norm-wise, as for FormFactorEnclosure.
double correctDigits(const FlatlandEnclosure& enclosure);

}  // namespace irradiff
