#include "derivatives/samples/hemicube_strata.h"

#include "derivatives/samples/grid_coordinate.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace irradiff {

namespace {

/// The half faces in their order: a turn of the face +t by `quarters` quarter turns about the normal.
Eigen::Vector3d turned(const Eigen::Vector3d& v, std::size_t quarters) {
  switch (quarters) {
    case 0:
      return v;
    case 1:
      return {-v.y(), v.x(), v.z()};
    case 2:
      return {-v.x(), -v.y(), v.z()};
    default:
      return {v.y(), -v.x(), v.z()};
  }
}

/// A side of a texel, on a face at distance 1.
struct TexelSide {
  double low, high;

  double sum() const { return low + high; }
};

/// Of a coordinate from -1 to 1 that enters by its magnitude alone: its texel in the half from 0 to 1.
TexelSide foldedSide(std::size_t index, std::size_t resolution) {
  const std::size_t half = resolution / 2;
  const std::size_t from_middle = index < half ? half - 1 - index : index - half;
  const auto all = static_cast<double>(half);
  return {static_cast<double>(from_middle) / all, static_cast<double>(from_middle + 1) / all};
}

/// Where the row `row` is: on the top face or on a half face, and its side there.
struct TexelRow {
  bool is_top;
  TexelSide side;
};

TexelRow texelRow(std::size_t row, std::size_t resolution) {
  if (row < resolution) return {true, foldedSide(row, resolution)};
  const std::size_t half = resolution / 2;
  return {false, foldedSide(half + (row - resolution) % half, resolution)};
}

/// The angle A(c) = atan(y1 / c) - atan(y0 / c) at c = sqrt(1 + x^2) for both ends of a side x0 <= x1, and its decrease
/// between them, each without cancellation.
struct SubtendedAngle {
  double low_root, high_root;  ///< c
  double roots_apart;
  double at_low;
  double decrease;
};

SubtendedAngle subtendedAngle(const TexelSide& x, const TexelSide& y, double width) {
  const double c0 = std::sqrt(1.0 + x.low * x.low);
  const double c1 = std::sqrt(1.0 + x.high * x.high);
  const double product = y.low * y.high;
  const double apart = width * x.sum() / (c0 + c1);
  const double at_low = std::atan2(c0 * width, c0 * c0 + product);
  // tan of A(c0) - A(c1), from the tangents c width / (c^2 + product); c >= 1 >= product.
  const double decrease = std::atan2(width * apart * (c0 * c1 - product),
                                     (c0 * c0 + product) * (c1 * c1 + product) + c0 * c1 * width * width);
  return {c0, c1, apart, at_low, decrease};
}

/// The integral over x and y of (1 + y^2 - x^2) / (1 + x^2 + y^2)^2, which with the same of x and y exchanged is twice
/// that of the cosine: the increase of x / c A(c).
double topFaceHalf(const TexelSide& x, const TexelSide& y, double width) {
  const SubtendedAngle angle = subtendedAngle(x, y, width);
  const double c0 = angle.low_root;
  const double c1 = angle.high_root;
  // x1 / c1 - x0 / c0, as a quotient of differences of squares.
  const double increase = width * x.sum() / (c0 * c1 * (x.high * c0 + x.low * c1));
  return increase * angle.at_low - x.high / c1 * angle.decrease;
}

/// The integral of the cosine z over a half face at distance 1: half the decrease of A(c) / c in z.
double halfFace(const TexelSide& z, const TexelSide& y, double width) {
  const SubtendedAngle angle = subtendedAngle(z, y, width);
  return (angle.decrease + angle.at_low * angle.roots_apart / angle.low_root) / (2.0 * angle.high_root);
}

/// Solid angle of a triangle whose vertices are on the plane at distance 1 and which has twice the area `twice_area`
/// there (Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", 1983, Eq. 8).
double triangleSolidAngle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                          double twice_area) {
  const double p_length = p.norm();
  const double q_length = q.norm();
  const double r_length = r.norm();
  return 2.0 * std::atan2(twice_area, p_length * q_length * r_length + p.dot(q) * r_length + q.dot(r) * p_length +
                                          r.dot(p) * q_length);
}

double texelWidth(const GridShape& shape) { return 2.0 / static_cast<double>(shape.columns); }

}  // namespace

Eigen::Vector3d hemicubeDirection(const GridShape& shape, const StratumPosition& position) {
  const std::size_t resolution = shape.columns;
  const double across = gridCoordinate({position.column, position.along_row}, resolution).centred;
  if (position.row < resolution) {
    const double up = gridCoordinate({position.row, position.along_column}, resolution).centred;
    return Eigen::Vector3d(across, up, 1.0).normalized();
  }
  const std::size_t half = resolution / 2;
  const std::size_t row = position.row - resolution;
  const double height = gridCoordinate({row % half, position.along_column}, half).from_start;
  return turned(Eigen::Vector3d(1.0, across, height).normalized(), row / half);
}

StratumPosition hemicubePosition(const GridShape& shape, const Eigen::Vector3d& direction) {
  const std::size_t resolution = shape.columns;
  const std::size_t half = resolution / 2;
  const double along_t = std::abs(direction.x());
  const double along_b = std::abs(direction.y());
  if (direction.z() >= std::max(along_t, along_b)) {
    const GridCell column = gridCell(direction.x() / direction.z(), resolution);
    const GridCell row = gridCell(direction.y() / direction.z(), resolution);
    return {row.index, column.index, column.along, row.along};
  }
  const std::size_t quarters = along_t >= along_b ? (direction.x() > 0.0 ? 0u : 2u) : (direction.y() > 0.0 ? 1u : 3u);
  const Eigen::Vector3d on_face = turned(direction, (4 - quarters) % 4);
  const GridCell column = gridCell(on_face.y() / on_face.x(), resolution);
  const double height = on_face.z() / on_face.x();
  const GridCell row = gridCell(height, (on_face.x() - on_face.z()) / on_face.x(), half);
  return {resolution + quarters * half + row.index, column.index, column.along, row.along};
}

// On the plane of the stratum's face. Directions that do not meet it are far from every stratum of the face, wherever
// they are put.
StratumPosition hemicubeNearestPosition(const GridShape& shape, std::size_t row, std::size_t column,
                                        const Eigen::Vector3d& direction) {
  const std::size_t resolution = shape.columns;
  const std::size_t half = resolution / 2;
  const bool is_top = row < resolution;
  const std::size_t quarters = is_top ? 0 : (row - resolution) / half;
  const Eigen::Vector3d turned_back = turned(direction, (4 - quarters) % 4);
  // Across the columns, across the rows, and out of the face.
  const Eigen::Vector3d on_face =
      is_top ? turned_back : Eigen::Vector3d(turned_back.y(), turned_back.z(), turned_back.x());
  const auto cells = [&](double across) {
    const double centred = on_face.z() > 0.0 ? across / on_face.z() : 0.0;
    return (1.0 + centred) / 2.0 * static_cast<double>(resolution);
  };
  const std::size_t line = is_top ? row : half + (row - resolution) % half;
  return {row, column, nearestAlong(column, cells(on_face.x())), nearestAlong(line, cells(on_face.y()))};
}

double hemicubeProjectedSolidAngle(const GridShape& shape, std::size_t row, std::size_t column) {
  const double width = texelWidth(shape);
  const TexelSide across = foldedSide(column, shape.columns);
  const TexelRow texel_row = texelRow(row, shape.columns);
  if (!texel_row.is_top) return halfFace(texel_row.side, across, width);
  return (topFaceHalf(across, texel_row.side, width) + topFaceHalf(texel_row.side, across, width)) / 2.0;
}

double hemicubeSolidAngle(const GridShape& shape, std::size_t row, std::size_t column) {
  const double width = texelWidth(shape);
  const TexelSide x = foldedSide(column, shape.columns);
  const TexelSide y = texelRow(row, shape.columns).side;
  const Eigen::Vector3d nearest(x.low, y.low, 1.0);
  const Eigen::Vector3d farthest(x.high, y.high, 1.0);
  return triangleSolidAngle(nearest, {x.high, y.low, 1.0}, farthest, width * width) +
         triangleSolidAngle(nearest, farthest, {x.low, y.high, 1.0}, width * width);
}

}  // namespace irradiff
