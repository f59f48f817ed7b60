#include "derivatives/scene/polygon.h"

#include "derivatives/scene/invalid_scene.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

using Wide = long double;
using WideVector = Eigen::Matrix<Wide, 3, 1>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Polygon polygonOf(std::vector<Vector3d> vertices) { return {"emitter", std::move(vertices), 1.0}; }

struct Refused {
  const char* name;
  Polygon polygon;
  std::vector<std::string> message;  // every part must occur
};

void PrintTo(const Refused& refused, std::ostream* stream) { *stream << refused.name; }

class RefusedPolygon : public testing::TestWithParam<Refused> {};

TEST_P(RefusedPolygon, IsNamedWithItsValueAndTheRule) {
  EXPECT_THAT([] { validate(GetParam().polygon, 3); },
              ThrowsMessage<InvalidScene>(HasSubstr("polygons[3] \"emitter\": ")));
  for (const std::string& part : GetParam().message) {
    EXPECT_THAT([] { validate(GetParam().polygon, 3); }, ThrowsMessage<InvalidScene>(HasSubstr(part)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Polygons, RefusedPolygon,
    testing::Values(
        Refused{"no_vertices", polygonOf({}), {"has 0 vertices", "at least 3"}},
        Refused{"two_vertices", polygonOf({{0, 0, 0}, {1, 0, 0}}), {"has 2 vertices", "at least 3"}},
        Refused{"nan", polygonOf({{0, 0, 0}, {1, 0, kNaN}, {0, 1, 0}}), {"vertex 1 (1, 0, nan)", "must be finite"}},
        Refused{"infinite",
                polygonOf({{0, 0, 0}, {1, 0, 0}, {0, -kInfinity, 0}}),
                {"vertex 2 (0, -inf, 0)", "must be finite"}},
        Refused{
            "negative_radiance", {"emitter", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, -0.5}, {"radiance is -0.5", ">= 0"}},
        Refused{"nan_radiance", {"emitter", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, kNaN}, {"radiance is nan", "finite"}},
        Refused{"infinite_radiance",
                {"emitter", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, kInfinity},
                {"radiance is inf", "finite"}},
        Refused{"repeated_neighbour",
                polygonOf({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
                {"vertex 2 (1, 0, 0) repeats vertex 1", "distinct"}},
        Refused{"repeated_last",
                polygonOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}),
                {"vertex 3 (0, 0, 0) repeats vertex 0"}},
        Refused{"repeated_zero_of_other_sign",
                polygonOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -0.0, 0}}),
                {"repeats vertex 0"}},
        Refused{"pinched",
                polygonOf({{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}}),
                {"vertex 4 (1, 1, 0) repeats vertex 1"}},
        Refused{"collinear", polygonOf({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}), {"no area", "on one line"}},
        Refused{"collinear_after_rounding",
                polygonOf({{0.1, 0.2, 0.3}, {0.1 + 0.7, 0.2 + 1.1, 0.3 + 1.3}, {0.1 + 2.1, 0.2 + 3.3, 0.3 + 3.9}}),
                {"no area", "on one line"}},
        Refused{"collinear_and_tiny", polygonOf({{0, 0, 0}, {1e-300, 1e-300, 0}, {3e-300, 3e-300, 0}}), {"no area"}},
        Refused{"bent",
                polygonOf({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1e-3}}),
                {"not planar", "vertex ", "from the plane", "must be within 1.0"}},
        Refused{"slightly_bent", polygonOf({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1e-9}}), {"not planar"}},
        Refused{"bent_and_huge",
                polygonOf({{0, 0, 0}, {1e150, 0, 0}, {1e150, 1e150, 0}, {0, 1e150, 1e147}}),
                {"not planar"}},
        Refused{"bent_and_tiny",
                polygonOf({{0, 0, 0}, {1e-150, 0, 0}, {1e-150, 1e-150, 0}, {0, 1e-150, 1e-153}}),
                {"not planar"}},
        Refused{"bow_tie",
                polygonOf({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}),
                {"self-intersecting", "edge 0 from (0, 0, 0) to (1, 1, 0) meets edge 2 from (1, 0, 0) to (0, 1, 0)"}},
        Refused{"tilted_bow_tie", polygonOf({{0, 0, 0}, {1, 1, 2}, {1, 0, 1}, {0, 1, 1}}), {"self-intersecting"}},
        Refused{"tiny_bow_tie",
                polygonOf({{0, 0, 0}, {1e-150, 1e-150, 0}, {1e-150, 0, 0}, {0, 1e-150, 0}}),
                {"self-intersecting"}},
        Refused{"huge_bow_tie",
                polygonOf({{0, 0, 0}, {1e150, 1e150, 0}, {1e150, 0, 0}, {0, 1e150, 0}}),
                {"self-intersecting"}},
        Refused{"spike",
                polygonOf({{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}}),
                {"self-intersecting", "edge 0", "meets edge 1"}},
        Refused{"vertex_on_edge",
                polygonOf({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 2, 0}}),
                {"self-intersecting", "common vertices only"}},
        Refused{"overlapping_edges",
                polygonOf({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
                {"self-intersecting"}},
        Refused{"vertices_on_top_of_each_other",
                polygonOf({{0, 0, 0}, {1, 0, 0}, {1, 0, 1e-12}, {0, 1, 0}}),
                {"self-intersecting", "vertex 2 (1, 0, 1e-12) coincides in the plane with vertex 1 (1, 0, 0)"}}),
    [](const auto& refused) { return std::string(refused.param.name); });

TEST(Validate, TellsWithoutAreaAndNotPlanarApartFromTheRest) {
  const auto validating = [](std::vector<Vector3d> vertices) {
    return [polygon = polygonOf(std::move(vertices))] { validate(polygon, 0); };
  };
  EXPECT_THROW(validating({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}})(), PolygonWithoutArea);
  EXPECT_THROW(validating({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1e-3}})(), NonPlanarPolygon);
  // Repeated vertices come before the plane, and edges that meet after it.
  for (const auto& other : {validating({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1e-3}}),
                            validating({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}})}) {
    try {
      other();
      ADD_FAILURE() << "accepted";
    } catch (const PolygonWithoutArea& error) {
      ADD_FAILURE() << error.what();
    } catch (const NonPlanarPolygon& error) {
      ADD_FAILURE() << error.what();
    } catch (const InvalidScene& error) {
      EXPECT_THAT(error.what(), testing::AnyOf(HasSubstr("distinct"), HasSubstr("meets edge")));
    }
  }
}

TEST(PolygonName, IsNotRepeatedWhereItIsTheDefaultOne) {
  const auto message = [](const std::string& name) { return [name] { validate(Polygon{name, {}, 1.0}, 7); }; };
  EXPECT_THAT(message(""), ThrowsMessage<InvalidScene>(testing::StartsWith("polygons[7]: ")));
  EXPECT_THAT(message("polygon 7"), ThrowsMessage<InvalidScene>(testing::StartsWith("polygons[7]: ")));
  EXPECT_THAT(message("polygon 8"), ThrowsMessage<InvalidScene>(testing::StartsWith("polygons[7] \"polygon 8\": ")));
}

struct Accepted {
  const char* name;
  std::vector<Vector3d> vertices;
};

void PrintTo(const Accepted& accepted, std::ostream* stream) { *stream << accepted.name; }

class AcceptedPolygon : public testing::TestWithParam<Accepted> {};

TEST_P(AcceptedPolygon, InEitherVertexOrder) {
  Polygon polygon = polygonOf(GetParam().vertices);
  EXPECT_NO_THROW(validate(polygon, 0));
  std::reverse(polygon.vertices.begin(), polygon.vertices.end());
  EXPECT_NO_THROW(validate(polygon, 0));
}

INSTANTIATE_TEST_SUITE_P(
    Polygons, AcceptedPolygon,
    testing::Values(
        Accepted{"triangle", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
        Accepted{"non_convex", {{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {1, 0.5, 1}, {0, 2, 1}}},
        Accepted{"with_a_straight_angle", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}},
        Accepted{"in_a_plane_through_an_axis", {{0, 0, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, 0}}},
        Accepted{"tiny", {{1e-150, 0, 0}, {0, 2e-150, 0}, {0, 0, 3e-150}}},
        Accepted{"huge", {{1e150, 0, 0}, {0, 2e150, 0}, {0, 0, 3e150}}},
        Accepted{"subnormal", {{1e-320, 0, 0}, {0, 2e-320, 0}, {0, 0, 3e-320}}},
        Accepted{"largest",
                 {{-1.7e308, -1.7e308, 0}, {1.7e308, -1.7e308, 0}, {1.7e308, 1.7e308, 0}, {-1.7e308, 1.7e308, 0}}},
        Accepted{"small_but_far", {{1e6, 1e6, 1e6}, {1e6 + 1, 1e6, 1e6}, {1e6 + 1, 1e6 + 1, 1e6}, {1e6, 1e6 + 1, 1e6}}},
        Accepted{"small_in_a_far_plane", {{1, 0, 0}, {1, 1e-200, 0}, {1, 1e-200, 1e-200}, {1, 0, 1e-200}}},
        Accepted{"sliver", {{0, 0, 0}, {1, 0, 0}, {1, 1e-12, 0}, {0, 1e-12, 0}}},
        Accepted{"sliver_beyond_rounding", {{0, 0, 0}, {1, 0, 0}, {1, 1e-100, 0}, {0, 1e-100, 0}}},
        Accepted{"hairline_L", {{0, 0, 0}, {1, 0, 0}, {1, 1e-12, 0}, {1e-12, 1e-12, 0}, {1e-12, 1, 0}, {0, 1, 0}}}),
    [](const auto& accepted) { return std::string(accepted.param.name); });

// Outlines in the plane z = 0 put somewhere in space in long double and rounded to double once, which is what the bound
// of kPlanarityRounding assumes. Seeded, so that a failure can be repeated.
class MovedPolygon : public testing::TestWithParam<int> {
 protected:
  Polygon moved(const std::vector<std::pair<Wide, Wide>>& outline, Wide size, Wide distance) {
    const Eigen::Quaternion<Wide> turn =
        Eigen::Quaternion<Wide>(normal_(random_), normal_(random_), normal_(random_), normal_(random_)).normalized();
    const WideVector offset = distance * WideVector(normal_(random_), normal_(random_), normal_(random_)).normalized();
    Polygon polygon = polygonOf({});
    for (const auto& [x, y] : outline) {
      polygon.vertices.emplace_back((turn * WideVector(size * x, size * y, 0) + offset).cast<double>());
    }
    return polygon;
  }

  // A star with a vertex on the line between two others here and there.
  std::vector<std::pair<Wide, Wide>> randomStar() {
    std::uniform_int_distribution<int> count_of(3, 12);
    std::uniform_real_distribution<double> radius_of(0.3, 1);
    const int count = count_of(random_);
    std::vector<std::pair<Wide, Wide>> outline;
    for (int i = 0; i < count; ++i) {
      const Wide angle = 2 * std::numbers::pi_v<Wide> * i / count;
      const Wide radius = radius_of(random_);
      outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return outline;
  }

  std::mt19937 random_{static_cast<unsigned>(GetParam())};
  std::normal_distribution<double> normal_;
};

TEST_P(MovedPolygon, StaysPlanarAMillionSizesAway) {
  for (int trial = 0; trial < 200; ++trial) {
    const auto outline = randomStar();
    for (const Wide size : {1e-150L, 1.0L, 1e150L}) {
      for (const Wide distance : {0.0L, 1.0L, 1e6L}) {
        const Polygon polygon = moved(outline, size, size * distance);
        ASSERT_NO_THROW(validate(polygon, 0)) << "trial " << trial << ", size " << size << ", distance " << distance;
      }
    }
  }
}

TEST_P(MovedPolygon, StaysPlanarAsASliver) {
  for (int trial = 0; trial < 200; ++trial) {
    const Wide width = 1e-12L;
    const std::vector<std::pair<Wide, Wide>> strip{{0, 0}, {0.5L, 0}, {1, 0}, {1, width}, {0.4L, width}, {0, width}};
    ASSERT_NO_THROW(validate(moved(strip, 1, 0), 0)) << "trial " << trial;
    const std::vector<std::pair<Wide, Wide>> hook{{0, 0}, {1, 0}, {1, width}, {width, width}, {width, 1}, {0, 1}};
    ASSERT_NO_THROW(validate(moved(hook, 1, 0), 0)) << "trial " << trial;
  }
}

TEST_P(MovedPolygon, IsRefusedWhereOneVertexLeavesThePlane) {
  for (int trial = 0; trial < 200; ++trial) {
    for (const Wide size : {1e-150L, 1.0L, 1e150L}) {
      Polygon polygon = moved({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, size, size);
      const Vector3d a = (polygon.vertices[1] - polygon.vertices[0]) / static_cast<double>(size);
      const Vector3d b = (polygon.vertices[2] - polygon.vertices[0]) / static_cast<double>(size);
      polygon.vertices[3] += static_cast<double>(size) * 1e-9 * a.cross(b).normalized();
      ASSERT_THAT([&] { validate(polygon, 0); }, ThrowsMessage<InvalidScene>(HasSubstr("not planar")));
    }
  }
}

TEST_P(MovedPolygon, IsRefusedWhereItIsALine) {
  for (int trial = 0; trial < 200; ++trial) {
    for (const Wide distance : {0.0L, 1.0L, 1e6L}) {
      const Polygon polygon = moved({{0, 0}, {0.3L, 0}, {1, 0}, {0.7L, 0}}, 1, distance);
      ASSERT_THAT([&] { validate(polygon, 0); }, ThrowsMessage<InvalidScene>(HasSubstr("no area")));
    }
  }
}

TEST_P(MovedPolygon, IsRefusedWhereItCrossesItself) {
  for (int trial = 0; trial < 200; ++trial) {
    for (const Wide size : {1e-150L, 1.0L, 1e150L}) {
      const Polygon polygon = moved({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, size, size * 1e6L);
      ASSERT_THAT(
          [&] { validate(polygon, 0); },
          ThrowsMessage<InvalidScene>(AllOf(HasSubstr("self-intersecting"), HasSubstr("edge 0"), HasSubstr("edge 2"))));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, MovedPolygon, testing::Range(1, 6));

TEST(PolygonSize, AHundredThousandVerticesAreNoProblem) {
  Polygon polygon = polygonOf({});
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCount;
    polygon.vertices.emplace_back(std::cos(angle), std::sin(angle), 2);
  }
  EXPECT_NO_THROW(validate(polygon, 0));
  std::swap(polygon.vertices[40000], polygon.vertices[60000]);
  EXPECT_THAT([&] { validate(polygon, 0); }, ThrowsMessage<InvalidScene>(HasSubstr("self-intersecting")));
}

}  // namespace
}  // namespace irradiff
