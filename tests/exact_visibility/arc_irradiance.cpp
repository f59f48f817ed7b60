#include "tests/exact_visibility/arc_irradiance.h"

#include <Eigen/Geometry>

#include <cmath>

namespace irradiff {

namespace {

Eigen::Vector3d approximation(const ExactVector& v) {
  return {v[0].approximation, v[1].approximation, v[2].approximation};
}

// Along p x q, its length the angle between them.
Eigen::Vector3d gamma(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  const Eigen::Vector3d normal = p.cross(q);
  const double sine = normal.norm();
  return sine == 0.0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(normal * (std::atan2(sine, p.dot(q)) / sine));
}

}  // namespace

double arcIrradiance(const ExactVisibility& seen, const std::vector<Polygon>& polygons, const Receiver& receiver) {
  const auto radiance = [&polygons](const FrontPolygon& front) { return front ? polygons[*front].radiance : 0.0; };
  double sum = 0.0;
  for (const ExactArc& arc : seen.arcs) {
    const Eigen::Vector3d begin = approximation(arc.begin.point) - receiver.position;
    const Eigen::Vector3d end = approximation(arc.end.point) - receiver.position;
    sum += (radiance(arc.right) - radiance(arc.left)) * receiver.normal.dot(gamma(begin, end));
  }
  // Counterclockwise about n, what is above the horizon is on the right; below there is nothing.
  for (const ExactHorizonArc& arc : seen.horizon) {
    sum +=
        polygons[arc.polygon].radiance * receiver.normal.dot(gamma(approximation(arc.begin), approximation(arc.end)));
  }
  return sum / 2.0;
}

}  // namespace irradiff
