#include "experiments/cache_3d/surface_radiance.h"

#include "verification/report/parallel_tasks.h"

#include <Eigen/Geometry>

namespace irradiff {

namespace {

/// Share of the largest coordinate; a position on a plane that is computed from a ray has a few roundings.
constexpr double kPlaneShare = 64 * 0x1p-52;

/// Newell's: twice the area times the normal, also of a polygon that is not convex.
Eigen::Vector3d areaVector(const Polygon& polygon) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::size_t count = polygon.vertices.size();
  for (std::size_t i = 1; i + 1 < count; ++i) {
    sum += (polygon.vertices[i] - polygon.vertices[0]).cross(polygon.vertices[i + 1] - polygon.vertices[0]);
  }
  return sum;
}

}  // namespace

SurfaceRadiance::Face SurfaceRadiance::layOut(const Polygon& polygon, double spacing) {
  Face face;
  face.normal = areaVector(polygon).normalized();
  const std::size_t count = polygon.vertices.size();
  Eigen::Vector3d longest = Eigen::Vector3d::Zero();
  double largest_coordinate = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d edge = polygon.vertices[(i + 1) % count] - polygon.vertices[i];
    if (edge.norm() > longest.norm() * (1.0 + 1e-9)) longest = edge;
    largest_coordinate = std::max(largest_coordinate, polygon.vertices[i].lpNorm<Eigen::Infinity>());
  }
  face.plane_rounding = kPlaneShare * largest_coordinate;
  face.column_axis = longest.normalized();
  face.row_axis = face.normal.cross(face.column_axis);
  Eigen::Array2d low = Eigen::Array2d::Zero();
  Eigen::Array2d high = Eigen::Array2d::Zero();
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    const Eigen::Vector3d offset = vertex - polygon.vertices[0];
    const Eigen::Array2d place(offset.dot(face.column_axis), offset.dot(face.row_axis));
    low = low.min(place);
    high = high.max(place);
  }
  const auto cells = [spacing](double extent) {
    return std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(extent / spacing * (1.0 - 1e-12))));
  };
  const std::size_t columns = cells(high[0] - low[0]);
  const std::size_t rows = cells(high[1] - low[1]);
  face.column_spacing = (high[0] - low[0]) / static_cast<double>(columns);
  face.row_spacing = (high[1] - low[1]) / static_cast<double>(rows);
  face.first_node = polygon.vertices[0] + (low[0] + 0.5 * face.column_spacing) * face.column_axis +
                    (low[1] + 0.5 * face.row_spacing) * face.row_axis;
  for (RadianceGrid& side : face.sides) {
    side.columns = columns;
    side.rows = rows;
  }
  return face;
}

SurfaceRadiance::SurfaceRadiance(std::span<const Polygon> polygons, double spacing, const Function& radiance,
                                 unsigned threads) {
  for (const Polygon& polygon : polygons) faces_.push_back(layOut(polygon, spacing));
  std::vector<std::function<void()>> tasks;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (std::size_t s = 0; s < 2; ++s) {
      RadianceGrid& side = faces_[f].sides[s];
      side.values.assign(side.rows * side.columns, 0.0);
      for (std::size_t row = 0; row < side.rows; ++row) {
        tasks.emplace_back([this, f, s, row, &radiance] {
          const Face& face = faces_[f];
          RadianceGrid& grid = faces_[f].sides[s];
          const Eigen::Vector3d normal = s == 0 ? face.normal : Eigen::Vector3d(-face.normal);
          for (std::size_t column = 0; column < grid.columns; ++column) {
            const Eigen::Vector3d position = face.first_node +
                                             static_cast<double>(column) * face.column_spacing * face.column_axis +
                                             static_cast<double>(row) * face.row_spacing * face.row_axis;
            grid.values[row * grid.columns + column] = radiance(f, position, normal);
          }
        });
      }
    }
  }
  runTasks(tasks, threads, {});
  for (Face& face : faces_) {
    for (RadianceGrid& side : face.sides) {
      if (std::ranges::all_of(side.values, [](double value) { return value == 0.0; })) side.values.clear();
    }
  }
}

SurfaceView SurfaceRadiance::view(std::size_t face_number, const SampleFrame& frame) const {
  const Face& face = faces_[face_number];
  const Eigen::Vector3d offset = frame.position - face.first_node;
  const double height = offset.dot(face.normal);
  SurfaceView view;
  const double rounding = face.plane_rounding + kPlaneShare * frame.position.lpNorm<Eigen::Infinity>();
  if (std::abs(height) <= rounding) return view;
  const Eigen::Matrix3d to_frame = frame.axes().transpose();
  view.grid = &face.sides[height > 0.0 ? 0 : 1];
  view.across = to_frame * face.column_axis / face.column_spacing;
  view.along = to_frame * face.row_axis / face.row_spacing;
  view.first_column = offset.dot(face.column_axis) / face.column_spacing;
  view.first_row = offset.dot(face.row_axis) / face.row_spacing;
  return view;
}

double SurfaceRadiance::at(std::size_t face_number, const Eigen::Vector3d& position,
                           const Eigen::Vector3d& viewer) const {
  const Face& face = faces_[face_number];
  const RadianceGrid& grid = face.sides[(viewer - face.first_node).dot(face.normal) > 0.0 ? 0 : 1];
  if (grid.values.empty()) return 0.0;
  const Eigen::Vector3d offset = position - face.first_node;
  return grid.at(offset.dot(face.column_axis) / face.column_spacing, offset.dot(face.row_axis) / face.row_spacing);
}

}  // namespace irradiff
