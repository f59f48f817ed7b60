#include "experiments/cache_2d/kernel_curvature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace irradiff {
namespace {

/// Of a cubic with three real roots, by Viete's cosines; a is not zero.
std::array<double, 3> realRoots(double a, double b, double c, double d) {
  const double shift = b / (3.0 * a);
  const double p = c / a - 3.0 * shift * shift;
  const double q = 2.0 * shift * shift * shift - shift * c / a + d / a;
  const double size = std::sqrt(std::max(0.0, -p / 3.0));
  const double cosine = size > 0.0 ? std::clamp(-0.5 * q / (size * size * size), -1.0, 1.0) : 0.0;
  const double angle = std::acos(cosine) / 3.0;
  std::array<double, 3> roots;
  for (int k = 0; k < 3; ++k) roots[k] = 2.0 * size * std::cos(angle - 2.0 * std::numbers::pi * k / 3.0) - shift;
  return roots;
}

}  // namespace

double kernelCurvature(const Eigen::Vector2d& start, const Eigen::Vector2d& step, const SeenEnd& first,
                       const SeenEnd& last) {
  // In z, or in 1/z where that polynomial has the larger leading coefficient. The direction of a root is (x, h).
  std::array<Eigen::Vector2d, 3> directions;
  if (std::abs(step.y()) >= std::abs(step.x())) {
    const auto roots = realRoots(2.0 * step.y(), -4.0 * step.x(), -3.0 * step.y(), step.x());
    std::ranges::transform(roots, directions.begin(), [](double z) { return Eigen::Vector2d(z, 1.0); });
  } else {
    const auto roots = realRoots(step.x(), -3.0 * step.y(), -4.0 * step.x(), 2.0 * step.y());
    std::ranges::transform(roots, directions.begin(), [](double w) { return Eigen::Vector2d(1.0, w); });
  }
  std::vector<double> places{first.along, last.along};
  for (const Eigen::Vector2d& d : directions) {
    const auto cross = [&d](const Eigen::Vector2d& v) { return d.x() * v.y() - d.y() * v.x(); };
    const double along = -cross(start) / cross(step);
    if (along > first.along && along < last.along) places.push_back(along);
  }
  std::ranges::sort(places);
  const auto curvature = [&](double along) {
    if (along == first.along) return first.wallTerms()[kSightCurvature];
    if (along == last.along) return last.wallTerms()[kSightCurvature];
    const Eigen::Vector2d p = start + along * step;
    return sightTerms(p.x(), p.y())[kSightCurvature];
  };
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) sum += std::abs(curvature(places[i + 1]) - curvature(places[i]));
  return sum;
}

}  // namespace irradiff
