// The cut at the horizon against 200 digits: what is kept, where it is cut, and what a plain double would make of it.

#include "derivatives/boundary/horizon_clip.h"

#include "verification/checks/input_families.h"
#include "verification/checks/random.h"
#include "verification/multiprecision/multiprecision.h"

#include <gtest/gtest.h>

#include <iostream>
#include <numbers>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;
constexpr double kUnitRoundoff = 0x1p-53;
using Eigen::Vector3d;
using Vertices = std::vector<Vector3d>;

Multiprecision exact(double value) { return value; }
Multiprecision exact(const DoubleWord<double>& value) { return Multiprecision(value.hi) + Multiprecision(value.lo); }

template <class WideScalar>
MultiprecisionVector exact(const Vector3<WideScalar>& v) {
  return {exact(v(0)), exact(v(1)), exact(v(2))};
}

double plain(const Multiprecision& value) { return value.convert_to<double>(); }

/// In units of u^2 times the distance of the farther end of the edge.
struct CrossingErrors {
  double off_horizon = 0.0;
  double off_edge = 0.0;
  std::size_t crossings = 0;
};

/// Compares a clipped loop, vertex by vertex, with the exact one.
template <class WideScalar>
void compareWithExact(const Vertices& vertices, const Vector3d& position, const Vector3d& normal,
                      CrossingErrors& errors) {
  const auto clipped =
      clipAtHorizon<double, WideScalar>(std::span<const Vector3d>(vertices), position, normal).vertices;
  const MultiprecisionVector n = withoutRounding(normal);
  std::vector<MultiprecisionVector> r;
  for (const Vector3d& vertex : vertices) {
    r.push_back(difference(withoutRounding(vertex), withoutRounding(position)));
  }
  std::size_t k = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const MultiprecisionVector& a = r[i];
    const MultiprecisionVector& b = r[(i + 1) % r.size()];
    const Multiprecision height_a = dot(n, a);
    const Multiprecision height_b = dot(n, b);
    if (height_a >= 0) {
      ASSERT_LT(k, clipped.size());
      EXPECT_GE(clipped[k].height, 0.0);
      EXPECT_LE(std::abs(clipped[k].height - plain(height_a)), kUnitRoundoff * plain(height_a));
      if constexpr (!std::is_same_v<WideScalar, double>) {
        EXPECT_EQ(plain(norm(difference(exact(clipped[k].position), a))), 0.0) << "vertex " << i;
      }
      ++k;
    }
    if (height_a * height_b < 0) {
      ASSERT_LT(k, clipped.size());
      EXPECT_EQ(clipped[k].height, 0.0);
      const MultiprecisionVector crossing = exact(clipped[k].position);
      const MultiprecisionVector edge = difference(b, a);
      const Multiprecision along = dot(difference(crossing, a), edge) / dot(edge, edge);
      EXPECT_GE(along, -kUnitRoundoff);
      EXPECT_LE(along, 1.0 + kUnitRoundoff);
      const Multiprecision unit = kUnitRoundoff * kUnitRoundoff * std::max(norm(a), norm(b));
      errors.off_horizon = std::max(errors.off_horizon, plain(abs(dot(n, crossing)) / unit));
      errors.off_edge =
          std::max(errors.off_edge,
                   plain(norm(cross(MultiprecisionVector(difference(crossing, a)), edge)) / (norm(edge) * unit)));
      ++errors.crossings;
      ++k;
    }
  }
  EXPECT_EQ(k, clipped.size());
}

/// A star-shaped, in general not convex polygon about a point of the horizon or near it, far from the origin.
Vertices drawPolygon(KeyedRandom& random, const Vector3d& position) {
  const Vector3d x = random.direction();
  const Vector3d y = x.cross(random.direction()).normalized();
  const Vector3d centre = position + random.decade(-2.0, 2.0) * random.direction();
  const std::size_t count = 3 + random.below(6);
  Vertices vertices;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2.0 * std::numbers::pi * (static_cast<double>(i) + random.unit()) / static_cast<double>(count);
    vertices.emplace_back(centre + random.decade(-4.0, 1.0) * (std::cos(turn) * x + std::sin(turn) * y));
  }
  return vertices;
}

template <class WideScalar>
CrossingErrors compareRandomPolygons() {
  CrossingErrors errors;
  for (std::size_t i = 0; i < lengthened(1500); ++i) {
    KeyedRandom random(kSeed, "horizon clip", i);
    const Vector3d position = random.decade(-3.0, 3.0) * random.direction();
    const Vertices vertices = drawPolygon(random, position);
    compareWithExact<WideScalar>(vertices, position, random.direction(), errors);
  }
  std::cout << errors.crossings << " crossings, seed " << kSeed << ": off the horizon by " << errors.off_horizon
            << ", off the edge by " << errors.off_edge << " u^2\n";
  return errors;
}

// Double words: products err by 5 u^2, sums by 3 u^2, quotients by 10 u^2; differences of inputs are exact. |r| stands
// for the farther end's.
//   heights n.r: 11 u^2 |r|, or u/512 of the height where it is grazing; it moves the crossing's height by no more
//   fraction: difference 3, quotient 10, times a height of at most |r|: 13 u^2 |r|
//   a + fraction (b - a): difference 3, product 5, times at most |b - a| <= 2 |r|; sum 3: 19 u^2 |r|
constexpr double kOffEdge = 19.0;
constexpr double kOffHorizon = 11.0 + 13.0 + kOffEdge;

TEST(HorizonClip, CutsWhereTheHorizonIs) {
  const CrossingErrors errors = compareRandomPolygons<DoubleWord<double>>();
  EXPECT_GT(errors.crossings, 1000U);
  EXPECT_LE(errors.off_horizon, kOffHorizon);
  EXPECT_LE(errors.off_edge, kOffEdge);
}

TEST(HorizonClip, PlainDoubleDoesNot) {
  CrossingErrors errors;
  for (std::size_t i = 0; i < 200; ++i) {
    KeyedRandom random(kSeed, "horizon clip in plain double", i);
    // Heights of at least a hundredth of the distance, so that plain double loses digits but not the sign.
    const Vertices vertices = {Vector3d(random.between(1.0, 2.0), 0.0, random.between(0.1, 1.0)),
                               Vector3d(random.between(1.0, 2.0), 1.0, random.between(0.1, 1.0)),
                               Vector3d(random.between(1.0, 2.0), 0.5, -random.between(0.1, 1.0))};
    const auto clipped =
        clipAtHorizon<double, double>(std::span<const Vector3d>(vertices), Vector3d::Zero(), Vector3d(0.0, 0.6, 0.8))
            .vertices;
    for (const auto& vertex : clipped) {
      if (vertex.height == 0.0) {
        const Multiprecision height = dot(withoutRounding(Vector3d(0.0, 0.6, 0.8)), exact<double>(vertex.position));
        errors.off_horizon = std::max(errors.off_horizon, plain(abs(height)) / (kUnitRoundoff * kUnitRoundoff));
        ++errors.crossings;
      }
    }
  }
  EXPECT_GT(errors.crossings, 100U);
  EXPECT_GT(errors.off_horizon, 1e6 * kOffHorizon);
}

Multiprecision exactHeight(const Vector3d& vertex, const Vector3d& position, const Vector3d& normal) {
  return dot(withoutRounding(normal), difference(withoutRounding(vertex), withoutRounding(position)));
}

TEST(HorizonClip, KnowsHeightsThatDoubledPrecisionCannotTellFromZero) {
  double worst = 0.0;
  std::size_t misjudged = 0;
  const std::size_t count = lengthened(500);
  for (std::size_t i = 0; i < count; ++i) {
    KeyedRandom random(kSeed, "grazing heights", i);
    const Vector3d normal = random.direction();
    const Vector3d vertex = normal.cross(random.direction());
    // Each coordinate of the receiver takes away what is left of the height, but for its own rounding: u, u^2, u^3.
    Vector3d position = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      position(k) = plain(exactHeight(vertex, position, normal) / normal(k));
    }
    const Multiprecision expected = exactHeight(vertex, position, normal);
    const auto height = horizonHeight<DoubleWord<double>>(vertex, position, normal);
    worst = std::max(worst, plain(abs(exact(height) - expected) / abs(expected)));
    const DoubleWord<double> doubled =
        dot(widen<DoubleWord<double>>(normal), wideDifference<DoubleWord<double>>(vertex, position));
    misjudged += (doubled.hi > 0.0) != (expected > 0);
  }
  EXPECT_LE(worst, kUnitRoundoff / 512.0);
  EXPECT_GT(misjudged, count / 4) << "the inputs are too easy: doubled precision tells their signs";
}

/// A comb with rectangular teeth in the plane y = 2, turned by `rotation`.
Vertices comb(const std::vector<double>& tooth_heights, const Eigen::Quaterniond& rotation) {
  Vertices vertices;
  double x = -1.0;
  for (const double height : tooth_heights) {
    vertices.emplace_back(x, 2.0, -0.5);
    vertices.emplace_back(x, 2.0, height);
    vertices.emplace_back(x + 0.25, 2.0, height);
    vertices.emplace_back(x + 0.25, 2.0, -0.5);
    x += 0.5;
  }
  vertices.emplace_back(x, 2.0, -1.0);
  vertices.emplace_back(-1.0, 2.0, -1.0);
  for (Vector3d& vertex : vertices) {
    vertex = rotation * vertex;
  }
  return vertices;
}

TEST(HorizonClip, KeepsTheTeethOfAComb) {
  const std::vector<double> tooth_heights = {0.5, 0.125, 1e-6, 0.75, -0.25};
  for (std::size_t i = 0; i < 20; ++i) {
    KeyedRandom random(kSeed, "combs", i);
    const Eigen::Quaterniond rotation =
        i == 0 ? Eigen::Quaterniond::Identity()
               : Eigen::Quaterniond(random.unit(), random.unit(), random.unit(), random.unit()).normalized();
    const Vector3d normal = (rotation * Vector3d::UnitZ()).normalized();
    const Vertices vertices = comb(tooth_heights, rotation);
    CrossingErrors errors;
    compareWithExact<DoubleWord<double>>(vertices, Vector3d::Zero(), normal, errors);
    EXPECT_EQ(errors.crossings, 8U);

    const auto clipped = clipAtHorizon<double>(std::span<const Vector3d>(vertices), Vector3d::Zero(), normal);
    EXPECT_TRUE(clipped.crosses_horizon);
    // Four teeth rise, each with two corners on the horizon and two above; the edges of the horizon between them add
    // nothing to the loop's area.
    EXPECT_EQ(clipped.vertices.size(), 16U);
    MultiprecisionVector area = MultiprecisionVector::Constant(Multiprecision(0));
    for (std::size_t k = 0; k < clipped.vertices.size(); ++k) {
      const MultiprecisionVector part = cross(exact(clipped.vertices[k].position),
                                              exact(clipped.vertices[(k + 1) % clipped.vertices.size()].position));
      for (int c = 0; c < 3; ++c) {
        area(c) += part(c) / 2;
      }
    }
    // Rotating the vertices rounds them: by 8 u of their distance in each tooth's sides and height.
    const double expected = 0.25 * (0.5 + 0.125 + 1e-6 + 0.75);
    EXPECT_NEAR(plain(norm(area)), expected, 64.0 * kUnitRoundoff);
  }
}

TEST(HorizonClip, LeavesAloneWhatIsWhollyAboveOrBelow) {
  const Vector3d up = Vector3d::UnitZ();
  const Vertices above = {{1.0, 0.0, 1.0}, {1.0, 1.0, 1.0}, {1.0, 0.5, 2.0}};
  const auto kept = clipAtHorizon<double>(std::span<const Vector3d>(above), Vector3d::Zero(), up);
  EXPECT_EQ(kept.vertices.size(), 3U);
  EXPECT_FALSE(kept.crosses_horizon);
  const auto gone = clipAtHorizon<double>(std::span<const Vector3d>(above), Vector3d(0.0, 0.0, 3.0), up);
  EXPECT_TRUE(gone.vertices.empty());
  EXPECT_TRUE(gone.crosses_horizon);
}

TEST(HorizonClip, TreatsVerticesOnTheHorizonAsTheyAre) {
  const Vector3d up = Vector3d::UnitZ();
  // An edge of the horizon, the rest above: nothing is cut.
  const Vertices standing = {{1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {1.0, 0.5, 2.0}};
  const auto kept = clipAtHorizon<double>(std::span<const Vector3d>(standing), Vector3d::Zero(), up);
  EXPECT_EQ(kept.vertices.size(), 3U);
  EXPECT_FALSE(kept.crosses_horizon);
  // The same below: nothing rises above.
  const Vertices hanging = {{1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {1.0, 0.5, -2.0}};
  EXPECT_TRUE(clipAtHorizon<double>(std::span<const Vector3d>(hanging), Vector3d::Zero(), up).vertices.empty());
  // Wholly on it: no part of it is above, and nothing was cut away.
  const Vertices flat = {{1.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {2.0, 0.5, 0.0}};
  const auto none = clipAtHorizon<double>(std::span<const Vector3d>(flat), Vector3d::Zero(), up);
  EXPECT_TRUE(none.vertices.empty());
  EXPECT_FALSE(none.crosses_horizon);
  // A vertex on it between one above and one below: the cut goes through the vertex, which is not doubled.
  const Vertices through = {{1.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {1.0, 0.5, -2.0}};
  const auto cut = clipAtHorizon<double>(std::span<const Vector3d>(through), Vector3d::Zero(), up);
  ASSERT_EQ(cut.vertices.size(), 3U);
  EXPECT_TRUE(cut.crosses_horizon);
  EXPECT_EQ(cut.vertices[0].height, 0.0);
  EXPECT_EQ(cut.vertices[2].height, 0.0);
}

}  // namespace
}  // namespace irradiff
