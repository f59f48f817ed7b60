#include "derivatives/flatland/strata_patches.h"

#include "derivatives/flatland/hit_line.h"
#include "derivatives/flatland/radiance_windows.h"

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <vector>

namespace irradiff {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

Matrix2d symmetricProduct(const Vector2d& a, const Vector2d& b) {
  const Matrix2d product = a * b.transpose();
  return product + product.transpose();
}

/// The angle that a patch takes and that angle's integral of n.w; rad.
struct PatchAngles {
  double angle;
  double projected;
};

struct PatchDerivatives {
  Vector2d gradient;  ///< 1/m
  Matrix2d hessian;   ///< 1/m^2
};

// A patch of length A on the line q, q.p = 1 there, adds A G, G(p) = (n.p)(q.p)/|p|^3 up to a constant factor. A is
// such that A G is the patch's projected angle. With u = 1/|p|, p = w/u and p moving against the receiver:
//   grad G / G = -{ u n/(n.w) + q - 3 u w }
//   hess G / G = u Q(n, q)/(n.w) - 3 u Q(u n/(n.w) + q, w) + u^2 (15 w w^T - 3 I),   Q(a, b) = a b^T + b a^T
// The angle stands for projected/(n.w), which is not finite at the horizon.
PatchDerivatives patchDerivatives(const Vector2d& w, double u, const Vector2d& q, const PatchAngles& angles) {
  const Vector2d n = Vector2d::UnitY();
  const Vector2d slopes = angles.angle * u * n + angles.projected * q;
  return {3.0 * angles.projected * u * w - slopes,
          angles.angle * u * symmetricProduct(n, q) - 3.0 * u * symmetricProduct(slopes, w) +
              angles.projected * u * u * (7.5 * symmetricProduct(w, w) - 3.0 * Matrix2d::Identity())};
}

/// The line of the surface at the hit of sample i, as the vector q with q.p = 1 on it. Requires a hit.
Vector2d surfaceLine(const FlatlandSamples& samples, std::size_t i) {
  const auto seen = [&samples](std::size_t k) {
    return SeenHit{samples.directions[k], samples.hits[k].inverse_distance};
  };
  double slope = 0.0;
  bool has_slope = false;
  const auto consider = [&](std::size_t k) {
    if (k >= samples.size() || samples.hits[k].inverse_distance == 0.0) return;
    const double candidate = slopeAtFirst(seen(i), seen(k));
    if (!std::isfinite(candidate) || (has_slope && std::abs(candidate) >= std::abs(slope))) return;
    slope = candidate;
    has_slope = true;
  };
  consider(i - 1);  // beyond every sample if i is 0
  consider(i + 1);
  return lineWithSlope(seen(i), slope);
}

/// Calls visit(sample, derivatives) for each hit's patch along the surface, filling the stratum.
template <class Visit>
void forEachSurfacePatch(const FlatlandSamples& samples, const Visit& visit) {
  const std::vector<Vector2d> borders = samples.strata.borders();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double u = samples.hits[i].inverse_distance;
    if (u == 0.0) continue;
    const Vector2d& start = borders[i];
    const Vector2d& stop = borders[i + 1];
    const PatchAngles angles{std::atan2(cross<double>(start, stop), start.dot(stop)), start.x() - stop.x()};
    visit(samples.hits[i], patchDerivatives(samples.directions[i], u, surfaceLine(samples, i), angles));
  }
}

/// What patches add up to at the radiances of their hits.
class PatchSum {
 public:
  void add(double radiance, const PatchDerivatives& patch) {
    if (radiance == 0.0) return;
    gradient_ += radiance * patch.gradient;
    hessian_ += radiance * patch.hessian;
  }

  FlatlandEstimate estimate(const FlatlandSamples& samples) const {
    FlatlandEstimate estimate = strataSums(samples);
    estimate.gradient = gradient_;
    estimate.knows_normal_component = true;
    estimate.hessian = hessian_;
    estimate.tangential_hessian = hessian_(0, 0);
    return estimate;
  }

 private:
  Vector2d gradient_ = Vector2d::Zero();
  Matrix2d hessian_ = Matrix2d::Zero();
};

}  // namespace

// A texel of length a on the side with outward normal f takes the angle a (f.w)^2, as a small one does.
FlatlandEstimate estimateHemicubeTexel(const FlatlandSamples& samples) {
  const std::size_t count = samples.strata.count();
  const double texel_length = 4.0 / static_cast<double>(count);
  PatchSum sum;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d& w = samples.directions[i];
    const double u = samples.hits[i].inverse_distance;
    const bool is_on_top = 4 * i >= count && 4 * i < 3 * count;
    const Vector2d side = is_on_top ? Vector2d(0.0, 1.0) : Vector2d(2 * i < count ? 1.0 : -1.0, 0.0);
    const double side_cosine = side.dot(w);
    const double angle = texel_length * side_cosine * side_cosine;
    sum.add(samples.hits[i].radiance, patchDerivatives(w, u, u / side_cosine * side, {angle, angle * w.y()}));
  }
  return sum.estimate(samples);
}

FlatlandEstimate estimateRadiometric(const FlatlandSamples& samples) {
  PatchSum sum;
  forEachSurfacePatch(samples,
                      [&sum](const FlatlandHit& hit, const PatchDerivatives& patch) { sum.add(hit.radiance, patch); });
  return sum.estimate(samples);
}

FlatlandEstimate estimateGeometric(const FlatlandSamples& samples) {
  double curvature = 0.0;
  forEachSurfacePatch(
      samples, [&](const FlatlandHit&, const PatchDerivatives& patch) { curvature += std::abs(patch.hessian(0, 0)); });
  FlatlandEstimate estimate = strataSums(samples);
  estimate.tangential_hessian = estimate.irradiance / 2.0 * curvature;
  return estimate;
}

}  // namespace irradiff
