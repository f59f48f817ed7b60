// The table of radiance over faces.

#include "experiments/cache_3d/surface_radiance.h"

#include "experiments/cache_3d/slice_view.h"
#include "tests/cache_3d/test_rooms.h"

#include <gtest/gtest.h>

#include <random>

namespace irradiff {
namespace {

const Eigen::Vector3d kSlope(0.3, -0.7, 0.45);

/// Linear on each face, another on either side.
double linearRadiance(std::size_t face, const Eigen::Vector3d& position, const Eigen::Vector3d& normal) {
  return 9.0 + static_cast<double>(face) + kSlope.dot(position) + normal.dot(Eigen::Vector3d(1, 2, 3));
}

/// A point of a triangle or of a convex polygon's first three corners.
Eigen::Vector3d pointOf(const Polygon& polygon, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  double a = share(random);
  double b = share(random);
  if (a + b > 1.0) {
    a = 1.0 - a;
    b = 1.0 - b;
  }
  return polygon.vertices[0] + a * (polygon.vertices[1] - polygon.vertices[0]) +
         b * (polygon.vertices[2] - polygon.vertices[0]);
}

TEST(SurfaceRadiance, HasLinearFunctionsOfBothSidesExactly) {
  const std::vector<Polygon> polygons = dataRoom("cornell_box").polygons;
  const SurfaceRadiance table(polygons, 0.21, linearRadiance, 2);
  std::mt19937 random(1);
  double worst = 0.0;
  for (std::size_t face = 0; face < polygons.size(); ++face) {
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3d point = pointOf(polygons[face], random);
      for (const double side : {1.0, -1.0}) {
        const Eigen::Vector3d normal = side * table.normal(face);
        const double value = table.at(face, point, point + 0.3 * normal);
        worst = std::max(worst, std::abs(value - linearRadiance(face, point, normal)));
        // The other side has another radiance: who mixed them up would be seen.
        EXPECT_GT(std::abs(value - linearRadiance(face, point, -normal)), 0.1);
      }
    }
  }
  EXPECT_LE(worst, 1e-13);  // 64 roundings of numbers up to 32; observed 1.1e-14
  RecordProperty("worst", std::to_string(worst));
}

TEST(SurfaceRadiance, IsTheSameThroughAView) {
  const std::vector<Polygon> polygons = furnace(1.0);
  const SurfaceRadiance table(
      polygons, 0.17,
      [](std::size_t face, const Eigen::Vector3d& p, const Eigen::Vector3d&) {
        return 2.0 + std::sin(3.0 * p.x() + static_cast<double>(face)) * std::cos(2.0 * p.y() - p.z());
      },
      1);
  const Receiver receiver{{0.3, 0.45, 0.0}, {0, 0, 1}};
  const SampleFrame frame = sampleFrame(receiver);
  std::mt19937 random(2);
  for (std::size_t face = 0; face < polygons.size(); ++face) {
    const SurfaceView view = table.view(face, frame);
    if (face == 0) {
      EXPECT_EQ(view.grid, nullptr) << "the receiver is in the floor's plane";
      continue;
    }
    for (int k = 0; k < 20; ++k) {
      const Eigen::Vector3d point = pointOf(polygons[face], random);
      const Eigen::Vector3d seen = frame.axes().transpose() * (point - frame.position);
      const double column = view.first_column + view.across.dot(seen);
      const double row = view.first_row + view.along.dot(seen);
      const double value = table.at(face, point, receiver.position);
      EXPECT_NEAR(view.grid->at(column, row), value, 1e-12);
      const RadianceGrid::Slope slope = view.grid->slopeAt(column, row);
      EXPECT_NEAR(slope.value, value, 1e-12);
      // Within a cell the bilinear function is linear along a row.
      const double aside =
          view.grid->at(std::floor(column) + 0.75, row) - view.grid->at(std::floor(column) + 0.25, row);
      if (column > 0.0 && column < static_cast<double>(view.grid->columns - 1)) {
        EXPECT_NEAR(slope.per_column, 2.0 * aside, 1e-12);
      }
    }
  }
}

TEST(SurfaceRadiance, IsNeverNegative) {
  const std::vector<Polygon> polygons{{"face", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0.0}};
  const SurfaceRadiance table(
      polygons, 0.1,
      [](std::size_t, const Eigen::Vector3d& p, const Eigen::Vector3d&) { return std::max(0.0, p.x() - 0.05); }, 1);
  EXPECT_EQ(table.at(0, {0.01, 0.5, 0}, {0, 0, 1}), 0.0);
  EXPECT_NEAR(table.at(0, {0.99, 0.5, 0}, {0, 0, 1}), 0.94, 1e-14);
}

TEST(SurfaceRadiance, DoesNotDependOnThreads) {
  const std::vector<Polygon> polygons = furnace(1.0);
  const SurfaceRadiance one(polygons, 0.3, linearRadiance, 1);
  const SurfaceRadiance three(polygons, 0.3, linearRadiance, 3);
  std::mt19937 random(3);
  for (std::size_t face = 0; face < polygons.size(); ++face) {
    const Eigen::Vector3d point = pointOf(polygons[face], random);
    EXPECT_EQ(one.at(face, point, {1, 1, 1.5}), three.at(face, point, {1, 1, 1.5}));
  }
}

}  // namespace
}  // namespace irradiff
