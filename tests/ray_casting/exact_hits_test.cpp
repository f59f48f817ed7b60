// Rays against exact ones, and how many of them hit against the exact visible region.

#include "derivatives/visibility/scene_evaluation.h"
#include "experiments/io/scene_file.h"
#include "experiments/ray_casting/ray_caster.h"
#include "tests/exact_visibility/random_scene.h"
#include "tests/ray_casting/ray_scenes.h"
#include "verification/exact_visibility/exact_rays.h"

#include <Eigen/Geometry>
#include <boost/math/distributions/chi_squared.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 23;

// Each polygon is known by its radiance.
std::vector<Polygon> numbered(std::vector<Polygon> polygons) {
  for (std::size_t i = 0; i < polygons.size(); ++i) polygons[i].radiance = static_cast<double>(i + 1);
  return polygons;
}

// What the distance of a hit is off by, in units of 2^-53 times what such a hit is sensitive to: the rounding of the
// coordinates, of the normal of a thin triangle, and of a direction along the plane.
double distanceError(const Polygon& polygon, const ExactHit& hit, double inverse, const Receiver& receiver,
                     const Eigen::Vector3d& direction) {
  double thinnest = 1.0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const std::size_t corners = polygon.vertices.size();
  for (std::size_t a = 0; a < corners; ++a) {
    for (std::size_t b = a + 1; b < corners; ++b) {
      for (std::size_t c = b + 1; c < corners; ++c) {
        const Eigen::Vector3d u = polygon.vertices[b] - polygon.vertices[a];
        const Eigen::Vector3d v = polygon.vertices[c] - polygon.vertices[a];
        const double sine = u.cross(v).norm() / (u.norm() * v.norm());
        // Triples that are no triangle of the polygon only make the bound wider; those on one line are none for sure.
        if (sine > 1e-9) thinnest = std::min(thinnest, sine);
        if (u.cross(v).norm() > normal.norm()) normal = u.cross(v);
      }
    }
  }
  double largest = receiver.position.lpNorm<Eigen::Infinity>();
  for (const Eigen::Vector3d& v : polygon.vertices) largest = std::max(largest, v.lpNorm<Eigen::Infinity>());
  const double cosine = std::abs(normal.normalized().dot(direction.normalized()));
  const double condition = (largest + hit.distance) / (hit.distance * cosine * thinnest);
  return std::abs(inverse * hit.distance - 1.0) / (0x1p-53 * condition);
}

TEST(ExactHits, EveryRayHitsWhatItHitsInRationalNumbers) {
  constexpr double kMostUnits = 16.0;
  double worst = 0.0;
  std::size_t hits = 0;
  std::size_t misses = 0;
  for (std::size_t i = 0; i < 30; ++i) {
    RandomScene scene = randomScene(kSeed, i, 2 + i / 3);
    scene.polygons = numbered(scene.polygons);
    const SampleFrame frame = frameAt(scene.receiver, i);
    HemisphereSamples by_faces = randomDirections(frame, i, 2000);
    HemisphereSamples by_tree = by_faces;
    const RayCaster every_face(scene.polygons, RaySearch::kEveryFace);
    const RayCaster tree(scene.polygons, RaySearch::kTree);
    every_face.from(frame).cast(by_faces);
    tree.from(frame).cast(by_tree);
    std::vector<Eigen::Vector3d> directions;
    for (std::size_t ray = 0; ray < 2000; ++ray) directions.emplace_back(frame.axes() * by_faces.direction(ray));
    const std::vector<std::optional<ExactHit>> exact = exactHits(scene.polygons, scene.receiver, directions);
    for (std::size_t ray = 0; ray < 2000; ++ray) {
      for (const HemisphereSamples* samples : {&by_faces, &by_tree}) {
        ASSERT_EQ(samples->radiance[ray], exact[ray] ? scene.polygons[exact[ray]->polygon].radiance : 0.0)
            << "scene " << i << ", ray " << ray;
        ASSERT_EQ(samples->inverse_distance[ray] == 0.0, !exact[ray]);
        if (!exact[ray]) continue;
        const double error = distanceError(scene.polygons[exact[ray]->polygon], *exact[ray],
                                           samples->inverse_distance[ray], scene.receiver, directions[ray]);
        ASSERT_LE(error, kMostUnits) << "scene " << i << ", ray " << ray;
        worst = std::max(worst, error);
      }
      ++(exact[ray] ? hits : misses);
    }
  }
  std::cout << hits << " hits, " << misses << " misses; distances off by at most " << worst << " units of "
            << kMostUnits << '\n';
  EXPECT_GT(hits, 10000U);
  EXPECT_GT(misses, 1000U);
  EXPECT_GT(worst, 0.01 * kMostUnits);
}

// Chi-square of the counts of hits on each polygon and on nothing, against the projected solid angles that are seen.
struct Statistic {
  double chi_square = 0.0;
  double degrees_of_freedom = 0.0;

  double probability() const {
    return boost::math::cdf(
        boost::math::complement(boost::math::chi_squared_distribution<double>(degrees_of_freedom), chi_square));
  }
};

Statistic hitStatistic(const std::vector<Polygon>& polygons, const Receiver& receiver, const HemisphereSamples& hits) {
  const std::size_t rays = hits.shape.size();
  // Rarer ones are counted with the background.
  constexpr double kFewestExpected = 10.0;
  Statistic statistic;
  double rest_expected = static_cast<double>(rays);
  double rest_counted = static_cast<double>(rays);
  const auto add = [&statistic](double counted, double expected) {
    statistic.chi_square += (counted - expected) * (counted - expected) / expected;
  };
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    std::vector<Polygon> alone = polygons;
    for (std::size_t j = 0; j < alone.size(); ++j) alone[j].radiance = i == j ? 1.0 : 0.0;
    const double seen = SceneEvaluator(alone).evaluate(receiver).derivatives.irradiance.value;
    const double expected = static_cast<double>(rays) * seen / std::numbers::pi;
    const auto counted = static_cast<double>(std::ranges::count(hits.radiance, polygons[i].radiance));
    if (expected < kFewestExpected) continue;
    add(counted, expected);
    rest_expected -= expected;
    rest_counted -= counted;
    ++statistic.degrees_of_freedom;
  }
  if (rest_expected >= kFewestExpected) {
    add(rest_counted, rest_expected);
  } else {
    // Closed: the counts add up to all rays.
    --statistic.degrees_of_freedom;
  }
  return statistic;
}

Scene sceneOf(const std::string& name) {
  std::ifstream file("data/scenes/" + name, std::ios::binary);
  EXPECT_TRUE(file) << name;
  return parseScene(std::string(std::istreambuf_iterator<char>(file), {}));
}

// `move` of the receiver that rays start from: where it is not where they are said to start, the counts must tell.
std::vector<double> probabilities(const Eigen::Vector3d& move) {
  std::vector<double> all;
  const auto add = [&all, &move](const std::vector<Polygon>& given, const Receiver& receiver, std::uint64_t seed) {
    const std::vector<Polygon> polygons = numbered(given);
    SampleFrame frame = frameAt(receiver, seed);
    frame.position += move;
    HemisphereSamples samples = randomDirections(frame, seed, 100000);
    const RayCaster caster(polygons);
    caster.from(frame).cast(samples);
    const Statistic statistic = hitStatistic(polygons, receiver, samples);
    if (statistic.degrees_of_freedom > 0.0) all.push_back(statistic.probability());
  };
  for (std::size_t i = 0; i < 40; ++i) {
    const RandomScene scene = randomScene(kSeed + 1, i, 4);
    add(scene.polygons, scene.receiver, i);
  }
  for (const char* name : {"figure5.json", "cornell_box.json", "three_tilted_occluders.json"}) {
    const Scene scene = sceneOf(name);
    for (std::size_t k = 0; k < 5; ++k) {
      add(scene.polygons, scene.receivers[(2 * k + 1) * scene.receivers.size() / 10], 100 + k);
    }
  }
  return all;
}

TEST(ExactHits, CountsAreThoseOfTheExactVisibleRegion) {
  const std::vector<double> all = probabilities({0, 0, 0});
  ASSERT_GE(all.size(), 50U);
  const double least = std::ranges::min(all);
  std::cout << all.size() << " chi-squares, the least probable " << least << '\n';
  // The least of so many is as small as this by chance once in a thousand.
  EXPECT_GT(least, 1e-3 / static_cast<double>(all.size()));
  // All of them together: as many below one half as above, to within 4 standard errors.
  const auto small = static_cast<double>(std::ranges::count_if(all, [](double p) { return p < 0.5; }));
  const auto count = static_cast<double>(all.size());
  EXPECT_NEAR(small, 0.5 * count, 4.0 * 0.5 * std::sqrt(count));
}

TEST(ExactHits, CountsTellAReceiverThatIsOffByTwoHundredths) {
  const std::vector<double> all = probabilities({0.02, 0.0, 0.0});
  const auto rejected = std::ranges::count_if(all, [](double p) { return p < 1e-5; });
  EXPECT_GT(rejected, static_cast<std::ptrdiff_t>(all.size() / 2));
}

}  // namespace
}  // namespace irradiff
