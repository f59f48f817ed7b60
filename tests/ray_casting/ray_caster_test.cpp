#include "experiments/ray_casting/ray_caster.h"

#include "experiments/ray_casting/ray_batch.h"
#include "tests/ray_casting/ray_scenes.h"
#include "verification/checks/random.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 5;
const Receiver kReceiver{{0, 0, 0}, {0, 0, 1}};
const SampleFrame kFrame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr RaySearch kSearches[] = {RaySearch::kEveryFace, RaySearch::kTree};

Polygon squareAt(double height, double half_width, double radiance) {
  const double w = half_width;
  return {"square", {{-w, -w, height}, {w, -w, height}, {w, w, height}, {-w, w, height}}, radiance};
}

std::size_t misses(const HemisphereSamples& samples) {
  return static_cast<std::size_t>(std::ranges::count(samples.inverse_distance, 0.0));
}

TEST(RayCaster, TheNearestPolygonIsSeen) {
  const std::vector<Polygon> polygons{squareAt(3, 1, 7), squareAt(1, 0.2, 0), squareAt(2, 0.5, 5)};
  for (const RaySearch search : kSearches) {
    const RayCaster caster(polygons, search);
    const ReceiverRays rays = caster.from(kFrame);
    EXPECT_EQ(rays.cast(Eigen::Vector3d(0, 0, 1)).inverse_distance, 1.0);
    EXPECT_EQ(rays.cast(Eigen::Vector3d(0, 0, 1)).radiance, 0.0);
    // Beside the near one, through the corner of the middle one.
    const RayHit middle = rays.cast(Eigen::Vector3d(0.49, 0.49, 2).normalized());
    EXPECT_NEAR(middle.inverse_distance, 1.0 / Eigen::Vector3d(0.49, 0.49, 2).norm(), 1e-15);
    EXPECT_EQ(middle.radiance, 5.0);
    EXPECT_EQ(rays.cast(Eigen::Vector3d(0.9, -0.9, 3).normalized()).radiance, 7.0);
    const RayHit nothing = rays.cast(Eigen::Vector3d(1.1, -0.9, 3).normalized());
    EXPECT_EQ(nothing.inverse_distance, 0.0);
    EXPECT_EQ(nothing.radiance, 0.0);
    const RayQuery query = rays.query();
    EXPECT_EQ(query(Eigen::Vector3d(0, 0, 1)).inverse_distance, 1.0);
  }
}

TEST(RayCaster, NothingAndWhatIsBelowIsNotSeen) {
  for (const RaySearch search : kSearches) {
    for (const std::vector<Polygon>& polygons : {std::vector<Polygon>{}, {squareAt(-1, 1, 1)}}) {
      HemisphereSamples samples = randomDirections(kFrame, kSeed, 1000);
      const RayCaster caster(polygons, search);
      caster.from(kFrame).cast(samples);
      EXPECT_EQ(misses(samples), 1000U);
      EXPECT_EQ(std::ranges::count(samples.radiance, 0.0), 1000);
    }
  }
}

TEST(RayCaster, OfTwoInOnePlaceTheFirstIsSeen) {
  for (const RaySearch search : kSearches) {
    for (const double first : {1.0, 2.0}) {
      const std::vector<Polygon> polygons{squareAt(1, 1, first), squareAt(1, 1, 3.0 - first)};
      const RayCaster caster(polygons, search);
      const ReceiverRays rays = caster.from(kFrame);
      for (const Eigen::Vector3d& w : {Eigen::Vector3d(0.1, 0.2, 1), Eigen::Vector3d(-0.3, 0.7, 1)}) {
        EXPECT_EQ(rays.cast(w.normalized()).radiance, first);
      }
    }
  }
}

TEST(RayCaster, BothSearchesGiveTheSameBits) {
  for (const std::size_t count : {1U, 8U, 64U, 500U}) {
    std::set<double> seen;
    for (std::uint64_t i = 0; i < 4; ++i) {
      const std::vector<Polygon> polygons = scatteredSquares(kSeed + i, count);
      KeyedRandom random(kSeed, "receiver", i);
      const SampleFrame frame = frameAt({0.3 * random.direction(), random.direction()}, i);
      HemisphereSamples by_faces = randomDirections(frame, i, 4096);
      HemisphereSamples by_tree = by_faces;
      const RayCaster every_face(polygons, RaySearch::kEveryFace);
      const RayCaster tree(polygons, RaySearch::kTree);
      every_face.from(frame).cast(by_faces);
      tree.from(frame).cast(by_tree);
      EXPECT_EQ(by_faces.inverse_distance, by_tree.inverse_distance) << count << " squares";
      EXPECT_EQ(by_faces.radiance, by_tree.radiance) << count << " squares";
      seen.insert(by_faces.radiance.begin(), by_faces.radiance.end());
    }
    // Nothing, and some of the squares.
    EXPECT_GT(seen.size(), std::min<std::size_t>(count / 2, 40));
  }
}

TEST(RayCaster, FarAwayATreeIsNotTrusted) {
  // A hundred tiny squares side by side, seen from where single precision cannot tell them apart.
  std::vector<Polygon> polygons;
  for (int i = 0; i < 100; ++i) {
    Polygon square = squareAt(0, 4e-4, 1.0 + i);
    for (Eigen::Vector3d& vertex : square.vertices) vertex.x() += 1e-3 * i;
    polygons.push_back(square);
  }
  const Receiver receiver{{0.05, 0.0, -3e6}, {0, 0, 1}};
  const SampleFrame frame = frameAt(receiver, kSeed);
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(100);
  for (int i = 0; i < 100; ++i) {
    directions.push_back(frame.axes().transpose() * (Eigen::Vector3d(1e-3 * i, 0, 0) - receiver.position));
  }
  HemisphereSamples samples = samplesAlong(frame, directions);
  const RayCaster caster(polygons, RaySearch::kTree);
  caster.from(frame).cast(samples);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(samples.radiance[i], 1.0 + static_cast<double>(i));
}

TEST(RayCaster, ARayDoesNotDependOnItsBatch) {
  const std::vector<Polygon> polygons = scatteredSquares(kSeed, 30);
  const SampleFrame frame = frameAt(kReceiver, kSeed);
  HemisphereSamples whole = randomDirections(frame, kSeed, 1500);
  const RayCaster caster(polygons);
  const ReceiverRays rays = caster.from(frame);
  rays.cast(whole);
  for (const std::size_t size : {1U, 3U, 7U, 16U, 511U, 513U}) {
    for (std::size_t begin = 0; begin < whole.shape.size(); begin += size) {
      HemisphereSamples part;
      part.frame = frame;
      for (std::size_t i = begin; i < std::min(begin + size, whole.shape.size()); ++i) {
        part.direction_t.push_back(whole.direction_t[i]);
        part.direction_b.push_back(whole.direction_b[i]);
        part.direction_n.push_back(whole.direction_n[i]);
      }
      rays.cast(part);
      for (std::size_t i = 0; i < part.radiance.size(); ++i) {
        ASSERT_EQ(part.inverse_distance[i], whole.inverse_distance[begin + i]);
        ASSERT_EQ(part.radiance[i], whole.radiance[begin + i]);
      }
    }
  }
  for (std::size_t i = 0; i < whole.shape.size(); ++i) {
    ASSERT_EQ(rays.cast(whole.direction(i)).inverse_distance, whole.inverse_distance[i]);
  }
}

// The kernel is compiled for several processors; this is what each of them must find, operation by operation.
TEST(RayCaster, TheKernelDoesWhatIsWritten) {
  const std::vector<Polygon> polygons = scatteredSquares(kSeed, 30);
  const SampleFrame frame = frameAt(kReceiver, kSeed);
  HemisphereSamples samples = randomDirections(frame, kSeed, 1500);
  std::vector<ViewedFace> faces;
  for (const Polygon& polygon : polygons) {
    for (const std::size_t third : {2U, 3U}) {
      const SceneFace face{{polygon.vertices[0], polygon.vertices[third - 1], polygon.vertices[third]},
                           polygon.radiance};
      if (const std::optional<ViewedFace> viewed = viewedFace(face, frame)) faces.push_back(*viewed);
    }
  }
  samples.inverse_distance.resize(1500);
  samples.radiance.resize(1500);
  castRays(faces, {samples.direction_t.data(), samples.direction_b.data(), samples.direction_n.data(),
                   samples.inverse_distance.data(), samples.radiance.data(), 1500});
  for (std::size_t i = 0; i < 1500; ++i) {
    const Eigen::Vector3d w = samples.direction(i);
    const auto product = [&w](const Eigen::Vector3d& v) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; };
    double nearest = 0.0;
    double radiance = 0.0;
    for (const ViewedFace& face : faces) {
      const bool is_inside = product(face.sides[0]) >= face.lowest[0] && product(face.sides[1]) >= face.lowest[1] &&
                             product(face.sides[2]) >= face.lowest[2];
      if (!is_inside || product(face.inverse_distance) <= nearest) continue;
      nearest = product(face.inverse_distance);
      radiance = face.radiance;
    }
    ASSERT_EQ(samples.inverse_distance[i], nearest);
    ASSERT_EQ(samples.radiance[i], radiance);
  }
}

TEST(RayCaster, NothingLeaksOutOfAClosedSurface) {
  for (std::uint64_t i = 0; i < 4; ++i) {
    const std::vector<Polygon> polygons = closedSurface(kSeed + i, 3);
    KeyedRandom random(kSeed, "inside", i);
    const Receiver receiver{0.1 * random.direction(), random.direction()};
    const SampleFrame frame = frameAt(receiver, i);
    std::vector<Eigen::Vector3d> directions;
    const auto aimAt = [&](const Eigen::Vector3d& point) {
      const Eigen::Vector3d direction = frame.axes().transpose() * (point - receiver.position);
      if (direction.z() > 1e-3) directions.push_back(direction);
    };
    for (const Polygon& polygon : polygons) {
      for (std::size_t a = 0; a < 3; ++a) {
        aimAt(polygon.vertices[a]);
        for (int step = 1; step < 20; ++step) {
          aimAt(polygon.vertices[a] + step / 20.0 * (polygon.vertices[(a + 1) % 3] - polygon.vertices[a]));
        }
      }
    }
    ASSERT_GT(directions.size(), 10000U);
    for (const RaySearch search : kSearches) {
      HemisphereSamples samples = samplesAlong(frame, directions);
      const RayCaster caster(polygons, search);
      caster.from(frame).cast(samples);
      EXPECT_EQ(misses(samples), 0U);
      for (const double inverse : samples.inverse_distance) {
        ASSERT_GT(inverse, 1.0 / 2.3);
        ASSERT_LT(inverse, 1.0 / 0.6);
      }
    }
    // The twin: without the margin of their sides, triangles lose rays between them.
    HemisphereSamples samples = samplesAlong(frame, directions);
    samples.inverse_distance.resize(directions.size());
    samples.radiance.resize(directions.size());
    std::vector<ViewedFace> faces;
    for (const Polygon& polygon : polygons) {
      const SceneFace face{{polygon.vertices[0], polygon.vertices[1], polygon.vertices[2]}, 1.0};
      if (std::optional<ViewedFace> viewed = viewedFace(face, frame)) {
        viewed->lowest = {0.0, 0.0, 0.0};
        faces.push_back(*viewed);
      }
    }
    castRays(faces, {samples.direction_t.data(), samples.direction_b.data(), samples.direction_n.data(),
                     samples.inverse_distance.data(), samples.radiance.data(), directions.size()});
    EXPECT_GT(misses(samples), 10U);
  }
}

TEST(RayCaster, UnitsOfLengthDoNotMatter) {
  const std::vector<Polygon> polygons = scatteredSquares(kSeed, 80);
  const SampleFrame frame = frameAt(kReceiver, kSeed);
  HemisphereSamples samples = randomDirections(frame, kSeed, 2000);
  const RayCaster caster(polygons);
  caster.from(frame).cast(samples);
  for (const int exponent : {-490, -20, 33, 490}) {
    std::vector<Polygon> scaled = polygons;
    for (Polygon& polygon : scaled) {
      for (Eigen::Vector3d& vertex : polygon.vertices) vertex *= std::ldexp(1.0, exponent);
    }
    HemisphereSamples again = samples;
    const RayCaster scaled_caster(scaled);
    scaled_caster.from(frame).cast(again);
    for (std::size_t i = 0; i < 2000; ++i) {
      ASSERT_EQ(again.inverse_distance[i], std::ldexp(samples.inverse_distance[i], -exponent));
    }
    EXPECT_EQ(again.radiance, samples.radiance);
  }
}

TEST(RayCaster, ManyPolygonsMakeATree) {
  // Both ways are taken by themselves too, and go on giving the same.
  for (const std::size_t count : {kMostPolygonsWithoutTree, kMostPolygonsWithoutTree + 1}) {
    const std::vector<Polygon> polygons = scatteredSquares(kSeed, count);
    HemisphereSamples samples = randomDirections(kFrame, kSeed, 500);
    HemisphereSamples by_faces = samples;
    const RayCaster caster(polygons);
    const RayCaster every_face(polygons, RaySearch::kEveryFace);
    caster.from(kFrame).cast(samples);
    every_face.from(kFrame).cast(by_faces);
    EXPECT_EQ(samples.inverse_distance, by_faces.inverse_distance);
  }
}

}  // namespace
}  // namespace irradiff
