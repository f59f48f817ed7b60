#include "derivatives/estimators/surface_patches.h"

#include "derivatives/samples/stratum_sides.h"

#include <Eigen/Geometry>

#include <array>
#include <limits>

namespace irradiff {

namespace {

Eigen::Matrix3d symmetricProduct(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Matrix3d product = a * b.transpose();
  return product + product.transpose();
}

using Neighbours = std::array<std::size_t, kStratumSides>;

/// No plane, and steeper than any.
const Eigen::Vector3d kNoPlane = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());

/// Keeps the plane that is farther from the receiver. False comparisons with NaN keep the first. Squares of what is far
/// away would be 0.
void keepFlatter(Eigen::Vector3d& plane, const Eigen::Vector3d& other) {
  if (other.stableNorm() < plane.stableNorm()) plane = other;
}

/// Through the hit of `stratum` and those of `a` and `b`. Along a plane the inverse distance is linear in the
/// direction, q.w = 1/r: solved for q in differences to the first sample, which lose nothing where neighbours are
/// close. Not finite if the three directions are on a great circle.
Eigen::Vector3d planeThrough(const HemisphereSamples& samples, std::size_t stratum, std::size_t a, std::size_t b) {
  const Eigen::Vector3d w = samples.direction(stratum);
  const Eigen::Vector3d to_a = samples.direction(a) - w;
  const Eigen::Vector3d to_b = samples.direction(b) - w;
  const double inverse_distance = samples.inverse_distance[stratum];
  const double rise_to_a = samples.inverse_distance[a] - inverse_distance;
  const double rise_to_b = samples.inverse_distance[b] - inverse_distance;
  const Eigen::Vector3d area = to_a.cross(to_b);
  return (inverse_distance * area + rise_to_a * to_b.cross(w) + rise_to_b * w.cross(to_a)) / w.dot(area);
}

/// From the hit of a stratum and those beside it alone.
Eigen::Vector3d flattestPlane(const HemisphereSamples& samples, std::size_t stratum, const Neighbours& neighbours) {
  const auto isHit = [&samples](std::size_t s) { return s != kNoStratum && samples.inverse_distance[s] > 0.0; };
  Eigen::Vector3d flattest = kNoPlane;
  for (std::size_t side = 0; side < kStratumSides; ++side) {
    const std::size_t a = neighbours[side];
    const std::size_t b = neighbours[(side + 1) % kStratumSides];
    if (isHit(a) && isHit(b)) keepFlatter(flattest, planeThrough(samples, stratum, a, b));
  }
  return flattest;
}

}  // namespace

SurfacePatches::SurfacePatches(const Strata& strata) : strata_(strata) {}

std::vector<Eigen::Vector3d> SurfacePatches::inversePlanes(const HemisphereSamples& samples) const {
  const GridShape shape = strata_.shape();
  const auto neighboursOf = [&](std::size_t stratum) {
    return stratumNeighbours(strata_, stratum / shape.columns, stratum % shape.columns);
  };
  std::vector<Eigen::Vector3d> own(shape.size(), kNoPlane);
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (samples.inverse_distance[i] > 0.0) own[i] = flattestPlane(samples, i, neighboursOf(i));
  }
  std::vector<Eigen::Vector3d> planes = own;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const Eigen::Vector3d w = samples.direction(i);
    const double inverse_distance = samples.inverse_distance[i];
    if (inverse_distance == 0.0) {
      planes[i].setZero();
      continue;
    }
    for (const std::size_t neighbour : neighboursOf(i)) {
      if (neighbour == kNoStratum || !own[neighbour].allFinite()) continue;
      const double along_ray = own[neighbour].dot(w);
      if (along_ray > 0.0) keepFlatter(planes[i], inverse_distance / along_ray * own[neighbour]);
    }
    if (!planes[i].allFinite()) planes[i] = inverse_distance * w;
  }
  return planes;
}

// A patch of area A in the plane q adds A G, G(p) = (n.p)(q.p)/|p|^4 up to a constant factor. A is such that A G is the
// stratum's projected solid angle P. With u = 1/r, p = w/u, q.p = 1 and p moving against the receiver:
//   grad G / G = -{ u n/(n.w) + q - 4 u w }
//   hess G / G = u Q(n, q)/(n.w) - 4 u Q(u n/(n.w) + q, w) + u^2 (24 w w^T - 4 I),   Q(a, b) = a b^T + b a^T
// P/(n.w) is the solid angle of a small stratum; the stratum's own stands for it, which is finite at the horizon.
PatchDerivatives SurfacePatches::derivatives(const HemisphereSamples& samples, std::size_t stratum,
                                             const Eigen::Vector3d& inverse_plane) const {
  const double u = samples.inverse_distance[stratum];
  if (u == 0.0) return {Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  const std::size_t columns = strata_.shape().columns;
  const double projected = strata_.projectedSolidAngle(stratum / columns, stratum % columns);
  const double solid_angle = strata_.solidAngle(stratum / columns, stratum % columns);
  const Eigen::Vector3d n = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d w = samples.direction(stratum);
  const Eigen::Vector3d slopes = solid_angle * u * n + projected * inverse_plane;
  return {4.0 * projected * u * w - slopes,
          solid_angle * u * symmetricProduct(n, inverse_plane) - 4.0 * u * symmetricProduct(slopes, w) +
              projected * u * u * (12.0 * symmetricProduct(w, w) - 4.0 * Eigen::Matrix3d::Identity())};
}

}  // namespace irradiff
