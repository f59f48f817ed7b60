#include "experiments/atlas/polygon_map.h"

#include "derivatives/scene/invalid_scene.h"
#include "verification/checks/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 1126;

/// A place of the map, away from its edges.
std::array<double, 2> placeOf(const PolygonMap& map, KeyedRandom& random) {
  const auto on = [&](const AtlasAxis& axis) {
    return axis.low * std::pow(axis.high / axis.low, random.between(0.05, 0.95));
  };
  const double x = on(map.x);
  const double y = on(map.y);
  return {x, y};
}

class EveryPolygonMap : public testing::TestWithParam<PolygonMap> {};

TEST_P(EveryPolygonMap, DrawsValidInputsOfTheWantedSizes) {
  const PolygonMap& map = GetParam();
  for (std::size_t i = 0; i < 200; ++i) {
    KeyedRandom random(kSeed, map.file, i);
    const auto [x, y] = placeOf(map, random);
    const Configuration input = map.draw(random, x, y);
    EXPECT_NO_THROW(validate(input.polygon, 0)) << sceneLine(input);
    EXPECT_NO_THROW(validate(input.receiver, 0)) << sceneLine(input);
    EXPECT_TRUE(isHeld(map, input, x, y)) << sceneLine(input);
    EXPECT_FALSE(isHeld(map, input, 1.5 * x, y)) << "a place beside it";
    EXPECT_FALSE(isHeld(map, input, x, y / 1.5)) << "a place below it";
  }
}

TEST_P(EveryPolygonMap, ToldThatPolygonIsBelowTheHorizon) {
  const PolygonMap& map = GetParam();
  KeyedRandom random(kSeed, map.file, 0);
  const auto [x, y] = placeOf(map, random);
  Configuration input = map.draw(random, x, y);
  input.receiver.normal = -input.receiver.normal;
  EXPECT_FALSE(isHeld(map, input, x, y));
}

INSTANTIATE_TEST_SUITE_P(Maps, EveryPolygonMap, testing::ValuesIn(polygonMaps()),
                         [](const auto& parameter) { return parameter.param.file; });

TEST(RoundedToFloat, HasCoordinatesThatFloatsHold) {
  KeyedRandom random(kSeed, "floats", 0);
  const Configuration input = polygonMaps()[0].draw(random, 0.5, 0.5);
  const Configuration rounded = roundedToFloat(input);
  const Eigen::Vector3d& before = input.polygon.vertices[1];
  const Eigen::Vector3d& after = rounded.polygon.vertices[1];
  EXPECT_EQ(after, after.cast<float>().cast<double>());
  EXPECT_NE(after, before);
  EXPECT_LE((after - before).norm(), 0x1p-24 * before.norm());
  EXPECT_TRUE(isHeld(polygonMaps()[0], rounded, 0.5, 0.5));
}

// What floats cannot hold is said to be so, and is not an error of a formula.
TEST(RoundedToFloat, LosesWhatIsSmallerThanItsSteps) {
  const PolygonMap& map = polygonMaps()[0];
  ASSERT_EQ(map.file, "size_grazing");
  KeyedRandom random(kSeed, "floats", 1);
  const Configuration input = map.draw(random, 1.0, 1e-10);
  EXPECT_TRUE(isHeld(map, input, 1.0, 1e-10));
  EXPECT_FALSE(isHeld(map, roundedToFloat(input), 1.0, 1e-10));
}

}  // namespace
}  // namespace irradiff
