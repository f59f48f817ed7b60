#include "verification/exact_visibility/exact_rays.h"

#include "tests/exact_visibility/arc_irradiance.h"
#include "tests/exact_visibility/random_scene.h"
#include "verification/exact_visibility/exact_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <numbers>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr std::size_t kScenes = 20;
constexpr std::size_t kOccluders = 4;
constexpr std::size_t kRays = 100000;
// Of 20 means, one is this far from the truth by chance with a probability of 0.1 %.
constexpr double kStandardErrors = 4.0;

struct CheckedScene {
  RandomScene scene;
  ExactVisibility seen;
  RayCastIrradiance rays;
};

const std::vector<CheckedScene>& checkedScenes() {
  static const std::vector<CheckedScene> kChecked = [] {
    std::vector<CheckedScene> checked;
    for (std::size_t i = 0; i < kScenes; ++i) {
      RandomScene scene = randomScene(kSeed, i, kOccluders);
      ExactVisibility seen = exactVisibility(scene.polygons, scene.receiver);
      const RayCastIrradiance rays = castExactRays(scene.polygons, scene.receiver, kSeed, kRays);
      checked.push_back({std::move(scene), std::move(seen), rays});
    }
    return checked;
  }();
  return kChecked;
}

// By how many standard errors it is off.
double deviation(double irradiance, const RayCastIrradiance& rays) {
  return std::abs(irradiance - rays.mean) / rays.standard_error;
}

double deviation(const ExactVisibility& seen, const CheckedScene& checked) {
  return deviation(arcIrradiance(seen, checked.scene.polygons, checked.scene.receiver), checked.rays);
}

bool showsSomethingBright(const CheckedScene& checked) {
  const auto is_bright = [&checked](const FrontPolygon& front) {
    return front && checked.scene.polygons[*front].radiance > 0.0;
  };
  return std::ranges::any_of(checked.seen.arcs,
                             [&is_bright](const ExactArc& arc) { return is_bright(arc.left) || is_bright(arc.right); });
}

// In how many of the scenes the rays reject what `spoil` makes of what is seen.
template <class Spoil>
std::size_t rejectedScenes(const Spoil& spoil) {
  const auto is_rejected = [&spoil](const CheckedScene& checked) {
    return deviation(spoil(checked), checked) > kStandardErrors;
  };
  return static_cast<std::size_t>(std::ranges::count_if(checkedScenes(), is_rejected));
}

TEST(ExactRays, ParallelSquareHasTheClosedForm) {
  // Howell B-3, four times the corner factor with sides and distance equal: E = 4 sqrt(1/2) atan(sqrt(1/2)).
  const Polygon square{"square", {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}, 1.0};
  const Receiver receiver{{0, 0, 0}, {0, 0, 1}};
  const double expected = 4.0 * std::sqrt(0.5) * std::atan(std::sqrt(0.5));
  const RayCastIrradiance rays = castExactRays({square}, receiver, kSeed, kRays);
  EXPECT_LE(std::abs(rays.mean - expected), kStandardErrors * rays.standard_error);
  // The variance of a hit is p (1 - p) with p = E / pi.
  const double p = expected / std::numbers::pi;
  EXPECT_NEAR(rays.standard_error, std::numbers::pi * std::sqrt(p * (1 - p) / kRays), 0.1 * rays.standard_error);
  // Turned away it gives nothing, from above and below.
  EXPECT_EQ(castExactRays({square}, {{0, 0, 0}, {0, 0, -1}}, kSeed, kRays).mean, 0.0);
  EXPECT_EQ(castExactRays({square}, {{0, 0, 1}, {0, 0, 1}}, kSeed, kRays).mean, 0.0);
}

TEST(ExactRays, ArcsHaveTheIrradianceOfTheRays) {
  double largest = 0.0;
  for (std::size_t i = 0; i < checkedScenes().size(); ++i) {
    const CheckedScene& checked = checkedScenes()[i];
    EXPECT_LE(deviation(checked.seen, checked), kStandardErrors)
        << "scene " << i << ": rays " << checked.rays.mean << " +- " << checked.rays.standard_error;
    largest = std::max(largest, deviation(checked.seen, checked));
  }
  std::cout << "at most " << largest << " standard errors in " << kScenes << " scenes\n";
}

TEST(ExactRays, EveryPolygonAloneHasTheIrradianceOfItsRays) {
  // E sees no arc between polygons of one radiance; with one bright polygon at a time it sees every side of every arc.
  constexpr std::size_t kFewerRays = 20000;
  double largest = 0.0;
  std::size_t seen = 0;
  for (const CheckedScene& checked : checkedScenes()) {
    for (std::size_t bright = 0; bright <= kOccluders; ++bright) {
      std::vector<Polygon> polygons = checked.scene.polygons;
      for (Polygon& polygon : polygons) polygon.radiance = 0.0;
      polygons[bright].radiance = 1.0;
      const RayCastIrradiance rays = castExactRays(polygons, checked.scene.receiver, kSeed, kFewerRays);
      // The standard error of a few hits is itself too uncertain.
      if (rays.mean < 0.01) continue;
      ++seen;
      const double irradiance = arcIrradiance(checked.seen, polygons, checked.scene.receiver);
      EXPECT_LE(deviation(irradiance, rays), kStandardErrors) << "polygon " << bright;
      largest = std::max(largest, deviation(irradiance, rays));
    }
  }
  std::cout << "at most " << largest << " standard errors for " << seen << " polygons\n";
  EXPECT_GE(seen, 2 * kScenes);
}

TEST(ExactRays, ArcsHaveTheIrradianceOfTheRaysWhereNothingIsInGeneralPosition) {
  constexpr std::size_t kTriangles = 16;
  double largest = 0.0;
  std::size_t bright = 0;
  std::size_t aligned = 0;
  std::size_t degenerate = 0;
  std::size_t edge_on = 0;
  for (std::size_t i = 0; i < kScenes; ++i) {
    const RandomScene scene = latticeScene(kSeed, i, kTriangles);
    CheckedScene checked{scene, exactVisibility(scene.polygons, scene.receiver),
                         castExactRays(scene.polygons, scene.receiver, kSeed, kRays)};
    // Where no ray hits anything bright, the estimate is 0 without an error.
    ASSERT_EQ(showsSomethingBright(checked), checked.rays.mean > 0.0) << "scene " << i;
    if (checked.rays.mean == 0.0) continue;
    ++bright;
    EXPECT_LE(deviation(checked.seen, checked), kStandardErrors)
        << "scene " << i << ": rays " << checked.rays.mean << " +- " << checked.rays.standard_error;
    largest = std::max(largest, deviation(checked.seen, checked));
    for (const ExactArc& arc : checked.seen.arcs) aligned += arc.aligned.size();
    for (const ExactApparentVertex& vertex : checked.seen.apparent_vertices) degenerate += vertex.degenerate ? 1U : 0U;
    edge_on += checked.seen.edge_on.size();
  }
  std::cout << "at most " << largest << " standard errors in " << bright << " scenes that are not dark; " << aligned
            << " lines aligned, " << degenerate << " degenerate vertices, " << edge_on << " triangles edge-on\n";
  EXPECT_GE(bright, kScenes / 2);
  EXPECT_GE(aligned, kScenes / 2);
  EXPECT_GE(degenerate, kScenes);
  EXPECT_GE(edge_on, kScenes / 2);
}

TEST(ExactRays, TheScenesHaveCreasesCrossingsAndHorizonArcs) {
  std::size_t creases = 0;
  std::size_t vertices = 0;
  std::size_t horizon = 0;
  for (const CheckedScene& checked : checkedScenes()) {
    creases += static_cast<std::size_t>(std::ranges::count(checked.seen.arcs, ExactLine::Kind::kCrease,
                                                           [](const ExactArc& arc) { return arc.line.kind; }));
    vertices += checked.seen.apparent_vertices.size();
    horizon += checked.seen.horizon.size();
  }
  std::cout << creases << " creases, " << vertices << " apparent vertices, " << horizon << " horizon arcs\n";
  EXPECT_GE(creases, kScenes);
  EXPECT_GE(vertices, kScenes);
  EXPECT_GE(horizon, kScenes / 2);
}

TEST(ExactRays, RejectAnOccluderIgnored) {
  // Not every occluder hides something, but in most scenes there is one.
  std::size_t rejected = 0;
  for (const CheckedScene& checked : checkedScenes()) {
    double largest = 0.0;
    for (std::size_t ignored = 1; ignored <= kOccluders; ++ignored) {
      std::vector<Polygon> fewer = checked.scene.polygons;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(ignored));
      const ExactVisibility seen = exactVisibility(fewer, checked.scene.receiver);
      largest = std::max(largest, deviation(arcIrradiance(seen, fewer, checked.scene.receiver), checked.rays));
    }
    rejected += largest > kStandardErrors ? 1U : 0U;
  }
  std::cout << "rejected in " << rejected << " scenes\n";
  EXPECT_GE(rejected, kScenes / 2);
}

TEST(ExactRays, RejectSidesSwapped) {
  EXPECT_EQ(rejectedScenes([](const CheckedScene& checked) {
              ExactVisibility swapped = checked.seen;
              for (ExactArc& arc : swapped.arcs) std::swap(arc.left, arc.right);
              return swapped;
            }),
            kScenes);
}

TEST(ExactRays, RejectAHiddenPieceOfAnEdgeCounted) {
  const auto point = [](const Eigen::Vector3d& v) {
    const auto number = [](double x) { return ExactRational{"", "", x}; };
    return ExactVector{number(v.x()), number(v.y()), number(v.z())};
  };
  const std::size_t rejected = rejectedScenes([&point](const CheckedScene& checked) {
    ExactVisibility longer = checked.seen;
    for (ExactArc& arc : longer.arcs) {
      if (arc.line.kind == ExactLine::Kind::kCrease || arc.end.kind != ExactLimitKind::kCrossing) continue;
      const std::vector<Eigen::Vector3d>& vertices = checked.scene.polygons[arc.line.polygon].vertices;
      arc.end.point = point(vertices[(arc.line.edge_or_partner + 1) % vertices.size()]);
    }
    return longer;
  });
  std::cout << "rejected in " << rejected << " scenes\n";
  EXPECT_GE(rejected, kScenes / 2);
}

TEST(ExactRays, RejectTheHorizonLeftOpen) {
  const std::size_t rejected = rejectedScenes([](const CheckedScene& checked) {
    ExactVisibility open = checked.seen;
    open.horizon.clear();
    return open;
  });
  std::cout << "rejected in " << rejected << " scenes\n";
  EXPECT_GE(rejected, kScenes / 4);
}

}  // namespace
}  // namespace irradiff
