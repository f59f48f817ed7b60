// The count of rounding errors by machine from the vertices of a polygon to its derivatives, the cut at the horizon
// included: docs/derivations/error_bounds.md, section 2.8.

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/horizon_clip.h"
#include "tests/boundary/tracked_scalar.h"
#include "verification/checks/input_families.h"
#include "verification/checks/random.h"

#include <gtest/gtest.h>

#include <iostream>
#include <numbers>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;
using Vertices = std::vector<Vector3<double>>;

struct PolygonCount {
  /// Worst-case errors as fractions of those that the production path allows: the constants and, in units of u, a
  /// rounding of the partial sum for every edge and every arc.
  double irradiance = 0.0;
  double derivatives = 0.0;
  double tangential_hessian = 0.0;
  double rotational_gradient = 0.0;
  std::size_t polygons = 0;

  void add(const Vertices& vertices, const Vector3<double>& normal) {
    const ErrorTape tape;
    std::vector<Vector3<Tracked>> tracked_vertices;
    const auto input = [](const Vector3<double>& v) {
      return Vector3<Tracked>(Tracked::input(v(0)), Tracked::input(v(1)), Tracked::input(v(2)));
    };
    for (const Vector3<double>& vertex : vertices) {
      tracked_vertices.push_back(input(vertex));
    }
    const Vector3<Tracked> tracked_normal = input(normal);
    const ClippedPolygon<Tracked> clipped = clipAtHorizon<Tracked>(
        std::span<const Vector3<Tracked>>(tracked_vertices), Vector3<Tracked>(input({0.0, 0.0, 0.0})), tracked_normal);
    if (clipped.vertices.empty()) {
      return;
    }
    const RadianceBoundary<Tracked> boundary = polygonBoundary(clipped, tracked_normal);
    const BoundarySums<Tracked> sums = boundarySums(boundary, tracked_normal);
    const auto arcs = static_cast<double>(clipped.vertices.size() + boundary.arcs.size());
    const auto fraction = [arcs](const Tracked& value, const Tracked& size, double constant) {
      return value.worstError() / (static_cast<double>(size.value()) * (constant + arcs));
    };
    irradiance = std::max(irradiance, fraction(sums.derivatives.irradiance.value, sums.irradiance_size, kAngleError));
    for (int i = 0; i < 3; ++i) {
      rotational_gradient = std::max(rotational_gradient, fraction(sums.derivatives.rotational_gradient.value(i),
                                                                   sums.rotational_size, kAngleError));
      derivatives = std::max(derivatives, fraction(sums.derivatives.gradient.value(i), sums.gradient_size, kArcError));
      for (int j = 0; j <= i; ++j) {
        derivatives =
            std::max(derivatives, fraction(sums.derivatives.hessian.value(i, j), sums.hessian_size, kArcError));
      }
    }
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b <= a; ++b) {
        tangential_hessian = std::max(tangential_hessian, fraction(sums.derivatives.tangential_hessian.value(a, b),
                                                                   sums.tangential_size, kTangentialError));
      }
    }
    ++polygons;
  }

  void print(const char* what) const {
    std::cout << polygons << ' ' << what << ", seed " << kSeed << ": irradiance " << irradiance
              << ", gradient and Hessian " << derivatives << ", tangential Hessian " << tangential_hessian
              << ", rotational gradient " << rotational_gradient << " of what is allowed\n";
  }
};

/// A star-shaped polygon of 3 to 8 vertices in a plane that passes the receiver at a distance of about 1.
Vertices drawPolygon(KeyedRandom& random) {
  const Vector3<double> plane_normal = random.direction();
  const Vector3<double> x = plane_normal.cross(random.direction()).normalized();
  const Vector3<double> y = plane_normal.cross(x);
  const Vector3<double> centre = random.decade(-1.0, 0.5) * plane_normal + random.between(-1.0, 1.0) * x;
  const std::size_t count = 3 + random.below(6);
  Vertices vertices;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2.0 * std::numbers::pi * (static_cast<double>(i) + random.unit()) / static_cast<double>(count);
    vertices.emplace_back(centre + random.decade(-1.0, 1.0) * (std::cos(turn) * x + std::sin(turn) * y));
  }
  return vertices;
}

/// A comb in the plane y = 1 with pointed teeth of the given height over the horizon z = 0, much narrower than the gaps
/// between them, and its back below.
Vertices comb(std::size_t teeth, double tooth_height) {
  Vertices vertices;
  for (std::size_t i = 0; i < teeth; ++i) {
    const double x = -1.0 + 2.0 * static_cast<double>(i) / static_cast<double>(teeth - 1);
    vertices.emplace_back(x - tooth_height, 1.0, -tooth_height);
    vertices.emplace_back(x, 1.0, tooth_height);
    vertices.emplace_back(x + tooth_height, 1.0, -tooth_height);
  }
  vertices.emplace_back(1.5, 1.0, -1.0);
  vertices.emplace_back(-1.5, 1.0, -1.0);
  return vertices;
}

TEST(PolygonErrorCount, OfRandomPolygonsIsBelowTheConstants) {
  PolygonCount count;
  for (std::size_t i = 0; i < lengthened(3000); ++i) {
    KeyedRandom random(kSeed, "polygons at the horizon", i);
    const Vertices vertices = drawPolygon(random);
    count.add(vertices, random.direction());
  }
  count.print("random polygons");
  EXPECT_GT(count.polygons, 1000U);
  EXPECT_LE(count.irradiance, 1.0);
  EXPECT_LE(count.derivatives, 1.0);
  EXPECT_LE(count.tangential_hessian, 1.0);
  EXPECT_LE(count.rotational_gradient, 1.0);
}

/// The edges of the horizon between the teeth are run through in both directions and cancel up to their rounding.
TEST(PolygonErrorCount, OfCombsIsBelowTheConstants) {
  PolygonCount count;
  for (const std::size_t teeth : {2U, 3U, 5U, 9U}) {
    for (const double tooth_height : {1e-1, 1e-2, 1e-3, 1e-4}) {
      count.add(comb(teeth, tooth_height), {0.0, 0.0, 1.0});
    }
  }
  count.print("combs");
  EXPECT_LE(count.irradiance, 1.0);
  EXPECT_LE(count.derivatives, 1.0);
  EXPECT_LE(count.tangential_hessian, 1.0);
  EXPECT_LE(count.rotational_gradient, 1.0);
}

}  // namespace
}  // namespace irradiff
