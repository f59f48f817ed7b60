#include "experiments/figures/derivative_map.h"

#include "derivatives/scene/invalid_scene.h"
#include "tests/figures/small_maps.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>

namespace irradiff {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kUnitRoundoff = 0x1p-53;

/// A grid in a plane that is aligned with no axis, 3 m x 2 m.
ReceiverGrid tiltedGrid(std::size_t width, std::size_t height) {
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized())).toRotationMatrix();
  return {{0.3, -0.2, 0.9}, 3 * turn.col(0), 2 * turn.col(1), turn.col(2), width, height};
}

QuadraticField generalField() {
  QuadraticField field{2.0, {0.5, -1.5, 0.25}, Eigen::Matrix3d::Zero()};
  field.curvature << 1, 0.5, -2, 0.5, -3, 0.75, -2, 0.75, 4;
  return field;
}

std::vector<std::uint64_t> bitsOf(const DerivativeMap& map) {
  std::vector<std::uint64_t> bits;
  for (const MapChannel& channel : map.channels) {
    for (const double value : channel.values) {
      bits.push_back(std::bit_cast<std::uint64_t>(value));
    }
  }
  return bits;
}

/// The error that rounding leaves in sums of a few products of these sizes: 16 operations of a unit roundoff each.
double roundingOf(double size) { return 16 * kUnitRoundoff * size; }

TEST(DerivativeMap, HoldsTheDerivativesInTheGridsFrame) {
  const QuadraticField field = generalField();
  const ReceiverGrid grid = tiltedGrid(5, 3);
  const DerivativeMap map = derivativeMap(grid, evaluatorOf(field), 2);
  // Along the sides: what the field's value does there, by its exact differences.
  const auto value = [&](double x, double y, double z, const Eigen::Vector3d& from) {
    return field.at(from + x * grid.u / 3 + y * grid.v / 2 + z * grid.normal, grid.normal).derivatives.irradiance.value;
  };
  // A quadratic's central differences are exact but for rounding, at any step; its values are below 64.
  const double first = roundingOf(64);
  const double second = 4 * first;
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 5; ++i) {
      const Eigen::Vector3d p = grid.receiver(i, j).position;
      const auto at = [&](const char* name) { return map.channel(name).values[j * 5 + i]; };
      EXPECT_EQ(at("E"), value(0, 0, 0, p));
      EXPECT_NEAR(at("gradient.x"), (value(1, 0, 0, p) - value(-1, 0, 0, p)) / 2, first);
      EXPECT_NEAR(at("gradient.y"), (value(0, 1, 0, p) - value(0, -1, 0, p)) / 2, first);
      EXPECT_NEAR(at("gradient.z"), (value(0, 0, 1, p) - value(0, 0, -1, p)) / 2, first);
      EXPECT_NEAR(at("hessian.xx"), value(1, 0, 0, p) - 2 * value(0, 0, 0, p) + value(-1, 0, 0, p), second);
      EXPECT_NEAR(at("hessian.yy"), value(0, 1, 0, p) - 2 * value(0, 0, 0, p) + value(0, -1, 0, p), second);
      EXPECT_NEAR(at("hessian.xy"),
                  (value(1, 1, 0, p) - value(1, -1, 0, p) - value(-1, 1, 0, p) + value(-1, -1, 0, p)) / 4, second);
      EXPECT_EQ(at("bound.E"), 1e-14);
      EXPECT_EQ(at("bound.gradient"), 2e-14);
      EXPECT_EQ(at("bound.hessian"), 3e-14);
      EXPECT_EQ(at("bound.tangential_hessian"), 4e-14);
    }
  }
}

TEST(DerivativeMap, TellsWhatFillingGapsLosesOfTheHessian) {
  QuadraticField field;
  field.curvature = Eigen::Vector3d(-5, 7, 0.5).asDiagonal();
  const DerivativeMap map = derivativeMap(
      tiltedGrid(2, 2),
      [field](const Receiver& receiver) {
        const SceneEvaluation<3> at = field.at(receiver.position, receiver.normal);
        return ViewEvaluation{at, {0.75 * at.derivatives.hessian.value}, {}};
      },
      1);
  EXPECT_THAT(map.channel("gap.hessian").values, testing::Each(testing::DoubleNear(0.25, 4 * roundingOf(1))));
  // Where nothing is lost it is 0.
  EXPECT_THAT(plainMap(2, 2).channel("gap.hessian").values, testing::Each(0.0));
}

TEST(DerivativeMap, HasTheEigenvaluesInSpaceLargestFirst) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(3, -1, 2).normalized()).toRotationMatrix();
  QuadraticField field;
  field.curvature = turn * Eigen::Vector3d(-5, 7, 0.5).asDiagonal() * turn.transpose();
  const DerivativeMap map = derivativeMap(tiltedGrid(2, 2), evaluatorOf(field), 1);
  const std::vector<double> expected{7, 0.5, -5};
  for (std::size_t k = 0; k < 3; ++k) {
    const MapChannel& channel = map.channel("lambda" + std::to_string(k + 1));
    EXPECT_THAT(channel.values, testing::Each(testing::DoubleNear(expected[k], 4 * roundingOf(7)))) << channel.name;
  }
}

TEST(DerivativeMap, NamesChannelsAndUnits) {
  const DerivativeMap map = plainMap(2, 2);
  std::vector<std::string> names;
  for (const MapChannel& channel : map.channels) {
    names.push_back(channel.name);
    EXPECT_EQ(channel.values.size(), 4U) << channel.name;
  }
  EXPECT_THAT(names, testing::ElementsAre("E", "gradient.x", "gradient.y", "gradient.z", "hessian.xx", "hessian.xy",
                                          "hessian.yy", "lambda1", "lambda2", "lambda3", "bound.E", "bound.gradient",
                                          "bound.tangential_hessian", "bound.hessian", "gap.hessian", "event"));
  EXPECT_EQ(map.channel("E").unit, "W/m^2");
  EXPECT_EQ(map.channel("gradient.z").unit, "W/m^3");
  EXPECT_EQ(map.channel("lambda3").unit, "W/m^4");
  EXPECT_THAT([&] { map.channel("albedo"); }, ThrowsMessage<std::out_of_range>(HasSubstr("albedo")));
}

TEST(DerivativeMap, HasNaNWhereAQuantityDoesNotExist) {
  const QuadraticField field = generalField();
  const auto missing_at = [&](auto spoil) {
    return derivativeMap(
        unitGrid(2, 1),
        [&, spoil](const Receiver& receiver) {
          SceneEvaluation<3> evaluation = field.at(receiver.position, receiver.normal);
          if (receiver.position.x() > 0.5) {
            spoil(evaluation);
          }
          return ViewEvaluation{evaluation, evaluation.derivatives.hessian, {}};
        },
        1);
  };
  const auto namesOfMissing = [](const DerivativeMap& map) {
    std::vector<std::string> names;
    for (const MapChannel& channel : map.channels) {
      EXPECT_FALSE(std::isnan(channel.values[0])) << channel.name;
      if (std::isnan(channel.values[1])) {
        names.push_back(channel.name);
      }
    }
    return names;
  };
  EXPECT_THAT(namesOfMissing(missing_at([](SceneEvaluation<3>&) {})), testing::IsEmpty());
  EXPECT_THAT(namesOfMissing(missing_at([](SceneEvaluation<3>& e) { e.no_irradiance = "why"; })),
              testing::UnorderedElementsAre("E", "bound.E"));
  EXPECT_THAT(namesOfMissing(missing_at([](SceneEvaluation<3>& e) { e.no_gradient = "why"; })),
              testing::UnorderedElementsAre("gradient.x", "gradient.y", "gradient.z", "bound.gradient"));
  EXPECT_THAT(namesOfMissing(missing_at([](SceneEvaluation<3>& e) { e.no_hessian = "why"; })),
              testing::UnorderedElementsAre("lambda1", "lambda2", "lambda3", "bound.hessian", "gap.hessian"));
  EXPECT_THAT(namesOfMissing(missing_at([](SceneEvaluation<3>& e) { e.no_tangential_hessian = "why"; })),
              testing::UnorderedElementsAre("hessian.xx", "hessian.xy", "hessian.yy", "bound.tangential_hessian"));
}

TEST(DerivativeMap, MarksBothSidesOfAnEventAndNothingElse) {
  // The topology changes along x = 0.5, and at the one receiver of cell (0, 3).
  const DerivativeMap map = derivativeMap(
      unitGrid(4, 4),
      [](const Receiver& receiver) {
        const Eigen::Vector3d& p = receiver.position;
        const bool is_odd_one = p.x() < 0.25 && p.y() > 0.75;
        VisibleBoundary topology;
        topology.is_seen = {p.x() > 0.5, is_odd_one};
        const SceneEvaluation<3> at = QuadraticField().at(p, receiver.normal);
        return ViewEvaluation{at, at.derivatives.hessian, topology};
      },
      1);
  EXPECT_THAT(map.channel("event").values, testing::ElementsAre(0, 1, 1, 0,  //
                                                                0, 1, 1, 0,  //
                                                                1, 1, 1, 0,  //
                                                                1, 1, 1, 0));
}

// The plane of the wall meets the grid's in a line, on both sides of which the wall shows another face.
TEST(DerivativeMap, OfASceneMarksWhereTheReceiverCrossesAPlane) {
  const std::vector<Polygon> polygons{{"wall", {{0.41, 2, 0.1}, {0.41, 3, 0.1}, {0.41, 2.5, 1}}, 1.0}};
  const DerivativeMap map = derivativeMap(unitGrid(10, 3), viewEvaluator(polygons), 1);
  for (std::size_t i = 0; i < 30; ++i) {
    const bool is_beside = i % 10 == 3 || i % 10 == 4;
    EXPECT_EQ(map.channel("event").values[i], is_beside ? 1.0 : 0.0) << i;
  }
}

TEST(DerivativeMap, IsTheSameForAnyNumberOfThreads) {
  const std::vector<Polygon> polygons{
      {"lamp", {{0.1, 0.2, 1}, {0.9, 0.15, 1.1}, {0.5, 0.8, 1.3}}, 3.0},
      {"wall", {{2, 0.2, -1}, {2, 0.9, -1}, {2, 0.9, 1}, {2, 0.2, 1}}, 0.5},
  };
  const ViewEvaluator evaluate = viewEvaluator(polygons);
  const std::vector<std::uint64_t> expected = bitsOf(derivativeMap(unitGrid(9, 13), evaluate, 1));
  for (const unsigned threads : {2U, 3U, 7U, 64U}) {
    EXPECT_EQ(bitsOf(derivativeMap(unitGrid(9, 13), evaluate, threads)), expected) << threads << " threads";
  }
  EXPECT_NE(bitsOf(derivativeMap(unitGrid(9, 13), viewEvaluator(std::span(polygons).first(1)), 1)), expected);
}

TEST(DerivativeMap, CountsRowsAndPassesOnWhatFails) {
  std::size_t calls = 0;
  std::size_t last = 0;
  derivativeMap(unitGrid(2, 5), evaluatorOf(generalField()), 3, [&](std::size_t done, std::size_t all) {
    ++calls;
    last = done;
    EXPECT_EQ(all, 5U);
  });
  EXPECT_EQ(calls, 5U);
  EXPECT_EQ(last, 5U);
  const std::vector<Polygon> hiding{{"lamp", {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}, 1.0},
                                    {"leaf", {{0, 0, 2}, {1, 0, 2}, {0.2, 1, 2}}, 2.0}};
  EXPECT_THROW(derivativeMap(unitGrid(2, 2), viewEvaluator(hiding), 2), InvalidScene);
}

TEST(DerivativeMap, NeedsAFrame) {
  const auto message = [](auto change) {
    ReceiverGrid grid = unitGrid(2, 2);
    change(grid);
    try {
      derivativeMap(grid, evaluatorOf(generalField()), 1);
    } catch (const InvalidScene& error) {
      return std::string(error.what());
    }
    return std::string("nothing was refused");
  };
  EXPECT_EQ(message([](ReceiverGrid&) {}), "nothing was refused");
  EXPECT_EQ(message([](ReceiverGrid& grid) { grid.u *= 7; }), "nothing was refused");
  EXPECT_THAT(message([](ReceiverGrid& grid) { grid.u.setZero(); }), HasSubstr("u has length 0, must be"));
  EXPECT_THAT(message([](ReceiverGrid& grid) { grid.v.x() = 1e-6; }), AllOf(HasSubstr("u and v"), HasSubstr("1e-12")));
  EXPECT_THAT(message([](ReceiverGrid& grid) { grid.v = {0, 0.6, 0.8}; }), HasSubstr("v and the normal is 0.8"));
  EXPECT_THAT(message([](ReceiverGrid& grid) { std::swap(grid.u, grid.v); }), HasSubstr("opposite to u x v"));
}

}  // namespace
}  // namespace irradiff
