// Direct light: analytic, and how far the table is from it.

#include "experiments/cache_3d/direct_light.h"

#include "tests/cache_3d/test_rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace irradiff {
namespace {

/// RMS of the table's difference from the analytic radiance over random points of faces, uniform in area, relative to
/// the mean.
struct TableError {
  double rms = 0.0;
  double mean = 0.0;
};

TableError tableError(const Room& room, const DirectLight& light, const SurfaceRadiance& table, int count) {
  std::vector<double> areas;
  for (const Polygon& polygon : room.polygons) {
    Eigen::Vector3d twice = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < polygon.vertices.size(); ++i) {
      twice += (polygon.vertices[i] - polygon.vertices[0]).cross(polygon.vertices[i + 1] - polygon.vertices[0]);
    }
    areas.push_back(0.5 * twice.norm());
  }
  std::mt19937 random(11);
  std::discrete_distribution<std::size_t> choose(areas.begin(), areas.end());
  std::uniform_real_distribution<double> share(0.0, 1.0);
  TableError error;
  for (int k = 0; k < count; ++k) {
    const std::size_t face = choose(random);
    const std::vector<Eigen::Vector3d>& v = room.polygons[face].vertices;
    // All are quadrilaterals: one of their two triangles by its area.
    const double first = (v[1] - v[0]).cross(v[2] - v[0]).norm();
    const double second = (v[2] - v[0]).cross(v[3] - v[0]).norm();
    const std::size_t corner = share(random) * (first + second) < first ? 1 : 2;
    double a = share(random);
    double b = share(random);
    if (a + b > 1.0) {
      a = 1.0 - a;
      b = 1.0 - b;
    }
    const Eigen::Vector3d point = v[0] + a * (v[corner] - v[0]) + b * (v[corner + 1] - v[0]);
    // The side towards the middle of the room.
    const Eigen::Vector3d inside(1.0, 0.9, 1.0);
    Eigen::Vector3d normal = table.normal(face);
    if (normal.dot(inside - point) < 0.0) normal = -normal;
    const double truth = light.radiance(face, {point, normal});
    const double difference = table.at(face, point, point + normal) - truth;
    error.rms += difference * difference;
    error.mean += truth;
  }
  error.mean /= count;
  error.rms = std::sqrt(error.rms / count) / error.mean;
  return error;
}

TEST(DirectLight, IsTheFormFactorOfTheLamp) {
  const Room room = cornerRoom();
  const DirectLight light(room);
  // Beneath the middle of a rectangle 2 a x 2 b at height c: F = 2/pi (A atan B/.. + ...) [Howell, B-3].
  const double x = 0.25 / 1.4;
  const double y = 0.3 / 1.4;
  const double quarter = (x / std::hypot(1.0, x) * std::atan(y / std::hypot(1.0, x)) +
                          y / std::hypot(1.0, y) * std::atan(x / std::hypot(1.0, y))) /
                         (2.0 * std::numbers::pi);
  const double expected = std::numbers::pi * 5.0 * 4.0 * quarter;
  EXPECT_NEAR(light.irradiance({{0.85, 1.0, 0.0}, {0, 0, 1}}), expected, 1e-14 * 20);
  EXPECT_NEAR(light.radiance(0, {{0.85, 1.0, 0.0}, {0, 0, 1}}), 0.5 / std::numbers::pi * expected, 1e-14 * 20);
  EXPECT_EQ(light.irradiance({{0.85, 1.0, 0.0}, {0, 0, -1}}), 0.0) << "from below";
  EXPECT_EQ(light.radiance(2, {{0.85, 1.0, 1.4}, {0, 0, -1}}), 0.0) << "the lamp reflects nothing";
}

TEST(DirectLight, OfTheCornellBoxIsNearItsTable) {
  const Room room = dataRoom("cornell_box");
  const DirectLight light(room);
  const TableError error = tableError(room, light, lightOfCornellBox(), 2000);
  std::printf("table of cornell_box: RMS %.4g of the mean %.4g\n", error.rms, error.mean);
  // At a shadow that begins at a block's foot the table errs by as much as the light, over a cell: that is a share of
  // about 0.01 m x 4 m/20 m^2 of the room, whose root is 0.04.
  EXPECT_LT(error.rms, 0.04);  // observed 0.015
  const SurfaceRadiance coarse(
      room.polygons, 0.5,
      [&](std::size_t face, const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
        return light.radiance(face, {p, n});
      },
      2);
  EXPECT_GT(tableError(room, light, coarse, 2000).rms, 0.04) << "bad twin: 4 nodes along a wall";
}

}  // namespace
}  // namespace irradiff
