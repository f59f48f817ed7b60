// A gradient of the form factor as a renderer may have it, against all oracles.
#include "verification/checks/suite.h"

#include <Eigen/Geometry>

#include <iostream>

using Eigen::Vector3d;

Vector3d myGradient(const std::vector<Vector3d>& v, const Vector3d& x, const Vector3d& n) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vector3d r = v[i] - x, e = v[(i + 1) % v.size()] - v[i], u = e.normalized();
    const Vector3d foot = r - u * u.dot(r), w = foot.normalized();  // of the perpendicular on the edge's line
    const double a = std::atan2(u.dot(r), foot.norm()), b = std::atan2(u.dot(r + e), foot.norm());
    const double cosines = 0.5 * (b - a + std::sin(b - a) * std::cos(b + a));  // integral of cos^2 from a to b
    const double mixed = 0.5 * std::sin(b - a) * std::sin(b + a);              // of sin cos
    sum += w.cross(u) * (n.dot(w) * cosines + n.dot(u) * mixed) / foot.norm();
  }
  return sum / M_PI;
}

int main() {
  irradiff::Candidate mine{"my gradient"};
  mine.gradient = [](const auto& c) { return myGradient(c.polygon.vertices, c.receiver.position, c.receiver.normal); };
  const auto verdicts = checkAll(mine, {.tolerance = 1e-13, .reference_folder = "data/reference"});
  std::cout << summarize(verdicts);
  return failures(verdicts).empty() ? 0 : 1;
}
