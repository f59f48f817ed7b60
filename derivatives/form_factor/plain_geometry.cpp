#include "derivatives/form_factor/plain_geometry.h"

#include "derivatives/boundary/horizon_height.h"

#include <cmath>

namespace irradiff {
namespace {

/// Twice the area times the normal, summed plainly, and the sum of the sizes of its terms.
struct PlainAreaVector {
  Vector3<double> sum = Vector3<double>::Zero();
  double size = 0.0;
};

PlainAreaVector areaVector(const PlainView& view, const Polygon& polygon) {
  PlainAreaVector area;
  const Eigen::Vector3d& apex = polygon.vertices[0];
  Vector3<double> previous = (polygon.vertices[1] - apex) * view.scale;
  for (std::size_t i = 2; i < view.count; ++i) {
    const Vector3<double> next = (polygon.vertices[i] - apex) * view.scale;
    area.sum += cross<double>(previous, next);
    area.size += 0.5 * (previous.squaredNorm() + next.squaredNorm());
    previous = next;
  }
  return area;
}

}  // namespace

Vector3<DoubleWord<double>> wideRelative(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double scale) {
  Vector3<DoubleWord<double>> result;
  for (int k = 0; k < 3; ++k) {
    const DoubleWord<double> exact = twoDifference(a(k), b(k));
    result(k) = {exact.hi * scale, exact.lo * scale};
  }
  return result;
}

WideCut wideCut(const PlainView& view, const Polygon& polygon, const Receiver& receiver, std::size_t seen,
                std::size_t hidden) {
  const Eigen::Vector3d& seen_vertex = polygon.vertices[seen];
  const Eigen::Vector3d& hidden_vertex = polygon.vertices[hidden];
  const auto height = [&receiver](const Eigen::Vector3d& vertex) {
    return horizonHeight<DoubleWord<double>>(vertex, receiver.position, receiver.normal);
  };
  const DoubleWord<double> seen_height = height(seen_vertex);
  WideCut cut{seen_height / (seen_height - height(hidden_vertex)),
              wideRelative(seen_vertex, receiver.position, view.scale)};
  const Vector3<DoubleWord<double>> edge = wideRelative(hidden_vertex, seen_vertex, view.scale);
  for (int k = 0; k < 3; ++k) {
    cut.position(k) = cut.position(k) + cut.fraction * edge(k);
  }
  return cut;
}

bool isOffPlane(const PlainView& view, const Polygon& polygon, const Receiver& receiver) {
  const PlainAreaVector area = areaVector(view, polygon);
  double coordinates = 1.0;
  for (int k = 0; k < 3; ++k) {
    coordinates += std::abs(receiver.position(k)) * view.scale;
  }
  // Vertices are within sqrt(3) of the receiver.
  return std::abs(dot(area.sum, view.vertices[0].position)) > 0x1p-42 * area.size * coordinates;
}

}  // namespace irradiff
