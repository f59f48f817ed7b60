#include "tests/figures/clipped_view.h"

#include "derivatives/form_factor/polygon_evaluation.h"

#include <Eigen/Core>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

namespace irradiff {
namespace {

using Outline = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Where the lines from the receiver through the polygon meet the plane at height z; counterclockwise.
Outline projected(const Polygon& polygon, const Receiver& receiver, double z) {
  Outline outline;
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    const double scale = (z - receiver.position.z()) / (vertex.z() - receiver.position.z());
    outline.emplace_back((receiver.position + scale * (vertex - receiver.position)).head<2>());
  }
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    area += cross(outline[i], outline[(i + 1) % outline.size()]);
  }
  if (area < 0.0) {
    std::ranges::reverse(outline);
  }
  return outline;
}

/// Sutherland and Hodgman's clip of one convex outline by another.
Outline intersection(Outline subject, const Outline& clip) {
  for (std::size_t i = 0; i < clip.size(); ++i) {
    const Eigen::Vector2d& a = clip[i];
    const Eigen::Vector2d edge = clip[(i + 1) % clip.size()] - a;
    Outline kept;
    for (std::size_t k = 0; k < subject.size(); ++k) {
      const Eigen::Vector2d& p = subject[k];
      const Eigen::Vector2d& q = subject[(k + 1) % subject.size()];
      const double p_side = cross(edge, p - a);
      const double q_side = cross(edge, q - a);
      if (p_side >= 0.0) {
        kept.push_back(p);
      }
      if ((p_side > 0.0 && q_side < 0.0) || (p_side < 0.0 && q_side > 0.0)) {
        kept.emplace_back(p + (p_side / (p_side - q_side)) * (q - p));
      }
    }
    subject = kept;
  }
  return subject;
}

double irradianceOf(const Outline& outline, double z, const Receiver& receiver) {
  Polygon polygon{"part", {}, 1.0};
  for (const Eigen::Vector2d& point : outline) {
    if (polygon.vertices.empty() || polygon.vertices.back().head<2>() != point) {
      polygon.vertices.emplace_back(point.x(), point.y(), z);
    }
  }
  while (polygon.vertices.size() > 1 && polygon.vertices.back() == polygon.vertices.front()) {
    polygon.vertices.pop_back();
  }
  return polygon.vertices.size() < 3 ? 0.0 : evaluatePolygon(polygon, 0, receiver).derivatives.irradiance.value;
}

}  // namespace

double irradianceByClipping(std::span<const Polygon> polygons, const Receiver& receiver) {
  const double z = polygons[0].vertices[0].z();
  std::vector<Outline> outlines;
  for (const Polygon& polygon : polygons) {
    outlines.push_back(projected(polygon, receiver, z));
  }
  double sum = 0.0;
  const std::size_t occluders = polygons.size() - 1;
  for (std::size_t subset = 0; subset < (std::size_t{1} << occluders); ++subset) {
    Outline outline = outlines[0];
    for (std::size_t i = 0; i < occluders; ++i) {
      if (((subset >> i) & 1U) != 0U) {
        outline = intersection(outline, outlines[i + 1]);
      }
    }
    sum += (std::popcount(subset) % 2 == 0 ? 1.0 : -1.0) * irradianceOf(outline, z, receiver);
  }
  return polygons[0].radiance * sum;
}

}  // namespace irradiff
