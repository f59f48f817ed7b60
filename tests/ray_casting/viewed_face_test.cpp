#include "experiments/ray_casting/viewed_face.h"

#include "tests/ray_casting/ray_scenes.h"
#include "verification/checks/random.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 11;

const SampleFrame kFrame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

bool isInImage(const ViewedFace& face, const Eigen::Vector3d& direction) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(face.sides[i].dot(direction) >= face.lowest[i])) return false;
  }
  return true;
}

TEST(ViewedFace, ImageAndDistanceAreThoseOfTheTriangle) {
  const SceneFace face{{{{-1, -1, 2}, {3, -1, 2}, {-1, 3, 2}}}, 5.0};
  for (const bool is_reversed : {false, true}) {
    SceneFace given = face;
    if (is_reversed) std::swap(given.vertices[1], given.vertices[2]);
    const std::optional<ViewedFace> viewed = viewedFace(given, kFrame);
    ASSERT_TRUE(viewed);
    EXPECT_EQ(viewed->radiance, 5.0);
    EXPECT_TRUE(isInImage(*viewed, {0, 0, 1}));
    EXPECT_TRUE(isInImage(*viewed, Eigen::Vector3d(-0.9, 0.9, 2).normalized()));
    EXPECT_FALSE(isInImage(*viewed, Eigen::Vector3d(-1.1, 0.9, 2).normalized()));
    EXPECT_FALSE(isInImage(*viewed, Eigen::Vector3d(1.1, 1.1, 2).normalized()));
    // What lies behind the receiver is no part of the image.
    EXPECT_FALSE(isInImage(*viewed, {0, 0, -1}));
    EXPECT_DOUBLE_EQ(viewed->inverse_distance.dot(Eigen::Vector3d(0, 0, 1)), 0.5);
    EXPECT_DOUBLE_EQ(viewed->inverse_distance.dot(Eigen::Vector3d(0.6, 0, 0.8)), 0.4);
  }
}

TEST(ViewedFace, WhatDoesNotRiseAboveTheHorizonHasNoImage) {
  EXPECT_FALSE(viewedFace({{{{1, 0, -1}, {0, 1, -2}, {1, 1, 0}}}, 1.0}, kFrame));
  EXPECT_TRUE(viewedFace({{{{1, 0, -1}, {0, 1, -2}, {1, 1, 1e-9}}}, 1.0}, kFrame));
}

TEST(ViewedFace, TheReceiversOwnSurfaceHasNoImage) {
  std::size_t off_plane = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    // A surface turned and moved, so that its coordinates and the receiver's are rounded.
    KeyedRandom random(kSeed, "surface", i);
    const Eigen::Vector3d normal = random.direction();
    const Eigen::Vector3d u = normal.unitOrthogonal();
    const Eigen::Vector3d v = normal.cross(u);
    const Eigen::Vector3d centre = random.decade(-2.0, 3.0) * random.direction();
    const SceneFace face{{centre + 3.0 * u, centre - 2.0 * u + 2.0 * v, centre - 2.0 * u - 2.0 * v}, 1.0};
    const Receiver receiver{centre + random.between(-0.5, 0.5) * u + random.between(-0.5, 0.5) * v, normal};
    // From above a hair's breadth of it, as a ray caster without a rule would see it.
    const Eigen::Vector3d plane =
        (face.vertices[1] - face.vertices[0]).cross(face.vertices[2] - face.vertices[0]).normalized();
    if (plane.dot(face.vertices[0] - receiver.position) != 0.0) ++off_plane;
    EXPECT_FALSE(viewedFace(face, frameAt(receiver, i))) << "surface " << i;
    // 10^-11 of the largest coordinate above it is a place above it.
    Receiver below = receiver;
    below.position -= 1e-11 * (centre.norm() + 3.0) * normal;
    EXPECT_TRUE(viewedFace(face, frameAt(below, i))) << "surface " << i;
  }
  // Or else nothing was asked of the rule.
  EXPECT_GT(off_plane, 500U);
}

// Rays at the vertices and at points of the edges: the triangle has them, whatever was rounded.
template <class Spoil>
std::size_t missedBorderRays(const Spoil& spoil) {
  std::size_t missed = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    KeyedRandom random(kSeed, "border", i);
    const Receiver receiver{random.direction(), random.direction()};
    const SampleFrame frame = frameAt(receiver, i);
    SceneFace face;
    for (Eigen::Vector3d& vertex : face.vertices) {
      // Above the horizon, and of very different sizes and distances.
      vertex = receiver.position + random.decade(-2.0, 2.0) * (receiver.normal + 0.9 * random.direction());
    }
    std::optional<ViewedFace> viewed = viewedFace(face, frame);
    if (!viewed) continue;
    spoil(*viewed);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d& vertex = face.vertices[corner];
      const Eigen::Vector3d direction = frame.axes().transpose() * (vertex - receiver.position);
      missed += isInImage(*viewed, direction.normalized()) ? 0 : 1;
    }
  }
  return missed;
}

TEST(ViewedFace, TheBorderBelongsToTheImage) {
  EXPECT_EQ(missedBorderRays([](ViewedFace&) {}), 0U);
  // Without its margin every other vertex is lost.
  EXPECT_GT(missedBorderRays([](ViewedFace& face) { face.lowest = {0.0, 0.0, 0.0}; }), 1000U);
}

}  // namespace
}  // namespace irradiff
