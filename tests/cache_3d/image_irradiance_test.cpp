// True irradiance between pixels.

#include "experiments/cache_3d/image_irradiance.h"

#include "tests/cache_3d/test_rooms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace irradiff {
namespace {

struct Made {
  std::vector<SeenPoint> seen;
  ImageIrradiance image;
};

/// Of a function of space and its gradient, as if it were irradiance.
template <class Value, class Gradient>
Made made(const Room& room, std::size_t width, const Value& value, const Gradient& gradient) {
  const std::vector<SeenPoint> seen = seenPoints(room, width);
  std::vector<double> values;
  std::vector<Eigen::Vector3d> gradients;
  for (const SeenPoint& point : seen) {
    values.push_back(value(point.receiver.position));
    gradients.push_back(gradient(point.receiver.position));
  }
  return {seen, ImageIrradiance(room.camera, width, seen, values, gradients)};
}

/// Worst difference from `value` a third and 2.7 of a pixel beside every third point.
template <class Value>
double worst(const Made& image, const Value& value) {
  double largest = 0.0;
  for (std::size_t i = 0; i < image.seen.size(); i += 3) {
    const SeenPoint& point = image.seen[i];
    const Eigen::Vector3d side = point.receiver.normal.unitOrthogonal();
    for (const double pixels : {0.37, -2.7}) {
      const Eigen::Vector3d there = point.receiver.position + pixels * point.pixel_size * side;
      if (const std::optional<double> found = image.image.at(i, there)) {
        largest = std::max(largest, std::abs(*found - value(there)));
      }
    }
  }
  return largest;
}

TEST(ImageIrradiance, HasLinearFunctionsExactlyAndQuadraticOnesNearly) {
  const Room room = dataRoom("cornell_box");
  const Eigen::Vector3d slope(0.7, -0.4, 0.9);
  const auto linear = [&](const Eigen::Vector3d& p) { return 3.0 + slope.dot(p); };
  const Made exact = made(room, 48, linear, [&](const Eigen::Vector3d&) { return slope; });
  EXPECT_LT(worst(exact, linear), 1e-13);
  // Bad twin: without gradients it is bilinear, which perspective and borders spoil.
  const Made plain = made(room, 48, linear, [](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); });
  EXPECT_GT(worst(plain, linear), 1e-2);

  const auto quadratic = [](const Eigen::Vector3d& p) { return p.squaredNorm() + p.x() * p.z(); };
  const Made curved = made(room, 48, quadratic, [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return 2.0 * p + Eigen::Vector3d(p.z(), 0, p.x());
  });
  // One-sided at borders it is of second order: half the largest eigenvalue of the Hessian, 3, times the square of what
  // a pixel covers of the floor at the back wall, 0.07 m x 4.75 m/0.99 m long.
  EXPECT_LT(worst(curved, quadratic), 0.5 * 3.0 * 0.34 * 0.34);  // observed 0.035
}

TEST(ImageIrradiance, KnowsNothingWhereTheCameraSeesAnotherSurface) {
  const Room room = dataRoom("cornell_box");
  const auto one = [](const Eigen::Vector3d&) { return 1.0; };
  const Made image = made(room, 48, one, [](const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); });
  std::size_t floor = 0;
  while (room.polygons[image.seen[floor].polygon].name != "floor") ++floor;
  EXPECT_TRUE(image.image.at(floor, image.seen[floor].receiver.position));
  EXPECT_FALSE(image.image.at(floor, {0.75, 1.7, 0.0})) << "hidden behind the tall block";
  EXPECT_FALSE(image.image.at(floor, {1.0, 3.0, 0.0})) << "behind the back wall";
  EXPECT_FALSE(image.image.at(floor, {1.0, -3.0, 0.0})) << "behind the camera";
  EXPECT_FALSE(image.image.at(floor, {-40.0, 1.0, 0.0})) << "beside the image";
}

}  // namespace
}  // namespace irradiff
