#include "derivatives/form_factor/polygon_evaluation.h"

#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/scene/invalid_scene.h"
#include "verification/checks/library_candidates.h"
#include "verification/checks/oracle.h"
#include "verification/checks/suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

namespace irradiff {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;

Polygon squareAt(double height) {
  return {"lamp", {{-0.5, -0.5, height}, {-0.5, 0.5, height}, {0.5, 0.5, height}, {0.5, -0.5, height}}, 1.0};
}

const Vector3d kUp(0.0, 0.0, 1.0);

std::string messageFor(const Polygon& polygon, const Receiver& receiver) {
  try {
    evaluatePolygon(polygon, 3, receiver);
  } catch (const InvalidScene& error) {
    return error.what();
  }
  return "";
}

TEST(EvaluatePolygon, SeesBothSidesAlike) {
  const Receiver below{{0.1, 0.2, 0.0}, kUp};
  const Receiver above{{0.1, 0.2, 2.0}, -kUp};
  const PolygonEvaluation from_below = evaluatePolygon(squareAt(1.0), 0, below);
  const PolygonEvaluation from_above = evaluatePolygon(squareAt(1.0), 0, above);
  EXPECT_NE(from_below.is_clockwise, from_above.is_clockwise);
  EXPECT_DOUBLE_EQ(from_below.derivatives.irradiance.value, from_above.derivatives.irradiance.value);
  EXPECT_GT(from_below.derivatives.irradiance.value, 0.0);
  // Towards the lamp irradiance grows, from either side.
  EXPECT_GT(from_below.derivatives.gradient.value(2), 0.0);
  EXPECT_DOUBLE_EQ(from_below.derivatives.gradient.value(2), -from_above.derivatives.gradient.value(2));
}

TEST(EvaluatePolygon, HugeCeilingFillsTheHemisphere) {
  Polygon ceiling = squareAt(1.0);
  for (Vector3d& v : ceiling.vertices) {
    v.head<2>() *= 1e8;
  }
  const PolygonEvaluation evaluation = evaluatePolygon(ceiling, 0, {{0.0, 0.0, 0.0}, kUp});
  EXPECT_NEAR(evaluation.derivatives.irradiance.value, std::numbers::pi, evaluation.bounds.irradiance + 1e-15);
}

/// A triangle `height` over the horizon of a tilted receiver: all but in the receiver's own plane.
Configuration lowTriangle(double height) {
  const Vector3d normal = Vector3d(0.36, 0.48, 0.8).normalized();
  const Eigen::Matrix<double, 3, 2> axes = tangentFrame<double>(normal);
  Configuration c{{"low", {}, 1.0}, {Vector3d::Zero(), normal}};
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(0.5, -0.4), Eigen::Vector2d(0.7, 0.9), Eigen::Vector2d(1.6, 0.2)}) {
    c.polygon.vertices.emplace_back(axes * corner + height * normal);
  }
  return c;
}

/// The largest difference over the largest entry of what is expected.
template <class Actual, class Expected>
double relativeError(const Actual& actual, const Expected& expected) {
  Multiprecision error = 0;
  Multiprecision norm = 0;
  for (Eigen::Index i = 0; i < actual.size(); ++i) {
    error = std::max<Multiprecision>(error, abs(Multiprecision(actual(i)) - expected(i)));
    norm = std::max<Multiprecision>(norm, abs(expected(i)));
  }
  return Multiprecision(error / norm).convert_to<double>();
}

/// What boundarySums adds up keeps its digits; the projected Hessian and n x V, which it takes the place of, do not.
TEST(EvaluatePolygon, KeepsTheDigitsOfTheTangentPlaneNearThePlaneOfAPolygon) {
  for (const double height : {1e-3, 1e-6, 1e-9}) {
    const Configuration c = lowTriangle(height);
    const OracleValue truth = *jetOracle().evaluate(c);
    const PolygonEvaluation evaluation = evaluatePolygon(c.polygon, 0, c.receiver);
    const double factor = (evaluation.is_clockwise ? 1.0 : -1.0) * std::numbers::inv_pi;
    const IrradianceDerivatives<double>& d = evaluation.derivatives;
    const double tangential = relativeError((factor * d.tangential_hessian.value).eval(), truth.tangential_hessian);
    const double rotational = relativeError((factor * d.rotational_gradient.value).eval(), truth.rotational_gradient);
    const double projected =
        relativeError((factor * tangentialHessian<double>(d.hessian.value, c.receiver.normal).value).eval(),
                      truth.tangential_hessian);
    Vector3d vector_irradiance = Vector3d::Zero();
    const ClippedPolygon<double> clipped =
        clipAtHorizon<double>(std::span<const Vector3d>(c.polygon.vertices), c.receiver.position, c.receiver.normal);
    for (const BoundaryArc<double>& arc : polygonBoundary(clipped, c.receiver.normal).arcs) {
      vector_irradiance += 0.5 * std::numbers::inv_pi * arc.angle * arc.plane_normal;
    }
    const double crossed = relativeError(c.receiver.normal.cross(vector_irradiance).eval(), truth.rotational_gradient);
    std::cout << "height " << height << ": tangential Hessian " << tangential << ", projected " << projected
              << "; rotational gradient " << rotational << ", n x V " << crossed << '\n';
    EXPECT_LE(tangential, 1e-13);
    EXPECT_LE(rotational, 1e-13);
    EXPECT_GE(projected, 100.0 * tangential);
    EXPECT_GE(crossed, 100.0 * rotational);
  }
}

TEST(EvaluatePolygon, NothingBelowTheHorizon) {
  const PolygonEvaluation evaluation = evaluatePolygon(squareAt(1.0), 0, {{0.0, 0.0, 2.0}, kUp});
  EXPECT_EQ(evaluation.rule, PolygonRule::kBelowHorizon);
  EXPECT_EQ(evaluation.derivatives.irradiance.value, 0.0);
  EXPECT_TRUE(evaluation.derivatives.hessian.value.isZero(0.0));
}

TEST(EvaluatePolygon, ReceiverOnItsOwnSurfaceReceivesNothingFromIt) {
  const PolygonEvaluation evaluation = evaluatePolygon(squareAt(1.0), 0, {{0.1, 0.2, 1.0}, kUp});
  EXPECT_EQ(evaluation.rule, PolygonRule::kOwnSurface);
  EXPECT_EQ(evaluation.derivatives.irradiance.value, 0.0);
  EXPECT_TRUE(evaluation.no_hessian.empty());
}

TEST(EvaluatePolygon, OwnSurfaceSurvivesTheRoundingOfARotation) {
  // Rounded coordinates put the receiver 1e-17 above or below its floor; neither may turn the floor into a ceiling.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  for (int i = 0; i < 100; ++i) {
    Polygon floor = squareAt(0.3 + 0.01 * i);
    const Vector3d x(0.003 * i, -0.002 * i, 0.3 + 0.01 * i);
    for (Vector3d& v : floor.vertices) {
      v = turn * v;
    }
    const PolygonEvaluation evaluation = evaluatePolygon(floor, 0, {turn * x, (turn * kUp).normalized()});
    EXPECT_EQ(evaluation.derivatives.irradiance.value, 0.0) << i;
  }
}

TEST(EvaluatePolygon, SheetInFrontOfTheReceiverFillsTheHemisphere) {
  // Its plane is exact: only coordinates along the plane's normal could be off by rounding, and they are not.
  for (const double shift : {0.0, 1e3, 1e6, 1e9}) {
    Polygon sheet = squareAt(0.0);
    for (Vector3d& v : sheet.vertices) {
      v(0) += shift;
    }
    for (const double height : {1e-17, 1e-15, 1e-12, 1e-9}) {
      const PolygonEvaluation evaluation = evaluatePolygon(sheet, 0, {{shift, 0.25, -height}, kUp});
      // What is seen beside the sheet is lower than its nearest edge, 1/4 away.
      const double beside = std::numbers::pi * std::pow(height / 0.25, 2);
      EXPECT_NEAR(evaluation.derivatives.irradiance.value, std::numbers::pi, evaluation.bounds.irradiance + beside)
          << shift << ' ' << height;
      EXPECT_EQ(evaluatePolygon(sheet, 0, {{shift, 0.25, -height}, -kUp}).derivatives.irradiance.value, 0.0);
    }
  }
}

TEST(EvaluatePolygon, NeighbourInTheReceiversOwnSurfaceGivesNothing) {
  // A receiver in the notch of a tile that rounding tilts: which vertices rise above the horizon is chance, and the cut
  // between them may run round the receiver, which then saw the whole hemisphere filled.
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.1 + 0.06 * i, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    Polygon tile{"tile", {{0, 0, 0.3}, {2, 0, 0.3}, {2, 1, 0.3}, {1, 1, 0.3}, {1, 2, 0.3}, {0, 2, 0.3}}, 1.0};
    for (Vector3d& v : tile.vertices) {
      v = turn * v;
    }
    const Receiver receiver{turn * Vector3d(1.01 + 0.009 * i, 1.5, 0.3), (turn * kUp).normalized()};
    EXPECT_EQ(evaluatePolygon(tile, 0, receiver).derivatives.irradiance.value, 0.0) << i;
  }
}

TEST(EvaluatePolygon, IrradianceIsNotNegativeWhereTheVerticesLeaveTheirPlane) {
  // The first vertex shows the receiver one side of the polygon and the last one the other.
  const Polygon bent{"bent", {{1, 0, 1e-11}, {2, 0, 0}, {2, 1, 0}, {1, 1, -1e-11}}, 1.0};
  for (const double height : {-1e-11, -5e-12, -1e-12, 0.0, 1e-12, 5e-12, 1e-11}) {
    const Receiver receiver{{0.0, 0.5, height}, Vector3d(1.0, 0.0, 0.0)};
    EXPECT_GE(evaluatePolygon(bent, 0, receiver).derivatives.irradiance.value, 0.0) << height;
  }
}

TEST(EvaluatePolygon, EdgeOnHasNoDerivatives) {
  const PolygonEvaluation evaluation = evaluatePolygon(squareAt(1.0), 3, {{2.0, 0.0, 1.0}, Vector3d(-1.0, 0.0, 0.0)});
  EXPECT_EQ(evaluation.rule, PolygonRule::kEdgeOn);
  EXPECT_EQ(evaluation.derivatives.irradiance.value, 0.0);
  EXPECT_THAT(evaluation.no_gradient, AllOf(HasSubstr("polygons[3] \"lamp\""), HasSubstr("edge-on")));
  EXPECT_FALSE(evaluation.no_hessian.empty());
}

TEST(EvaluatePolygon, WallStandingOnTheHorizonHasAOneSidedHessian) {
  const Polygon wall{"wall", {{1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}, {1.0, 1.0, 2.0}, {1.0, -1.0, 2.0}}, 1.0};
  const PolygonEvaluation evaluation = evaluatePolygon(wall, 3, {{0.0, 0.0, 0.0}, kUp});
  EXPECT_TRUE(evaluation.no_gradient.empty());
  EXPECT_THAT(evaluation.no_hessian, AllOf(HasSubstr("polygons[3] \"wall\""), HasSubstr("horizon")));
  // The reported Hessian is the limit from above the floor, where the wall's foot has sunk below the horizon.
  const PolygonEvaluation above = evaluatePolygon(wall, 3, {{0.0, 0.0, 1e-9}, kUp});
  EXPECT_LT((evaluation.derivatives.hessian.value - above.derivatives.hessian.value).cwiseAbs().maxCoeff(), 1e-8);
  // From below the foot is above the horizon: the second derivative along the normal jumps, the others do not.
  const PolygonEvaluation below = evaluatePolygon(wall, 3, {{0.0, 0.0, -1e-9}, kUp});
  const Eigen::Matrix3d jump = below.derivatives.hessian.value - evaluation.derivatives.hessian.value;
  EXPECT_GT(std::abs(jump(2, 2)), 0.1);
  EXPECT_LT((jump - jump(2, 2) * kUp * kUp.transpose()).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(EvaluatePolygon, TileBesideTheReceiverHasAOneSidedHessian) {
  // It lies in the horizon plane: invisible from here and above, seen from below.
  Polygon tile = squareAt(0.0);
  for (Vector3d& v : tile.vertices) {
    v(0) += 2.0;
  }
  const PolygonEvaluation evaluation = evaluatePolygon(tile, 3, {{0.0, 0.0, 0.0}, kUp});
  EXPECT_EQ(evaluation.derivatives.irradiance.value, 0.0);
  EXPECT_TRUE(evaluation.no_gradient.empty());
  EXPECT_THAT(evaluation.no_hessian, AllOf(HasSubstr("polygons[3] \"lamp\""), HasSubstr("one-sided")));
  EXPECT_GT(evaluatePolygon(tile, 3, {{0.0, 0.0, -1e-6}, kUp}).derivatives.hessian.value(2, 2), 0.01);
}

TEST(EvaluatePolygon, RefusesAReceiverOnAVertex) {
  EXPECT_THAT(messageFor(squareAt(1.0), {{0.5, 0.5, 1.0}, -kUp}),
              AllOf(HasSubstr("polygons[3] \"lamp\""), HasSubstr("vertices[2]"), HasSubstr("[0.5, 0.5, 1]")));
}

TEST(EvaluatePolygon, RefusesAReceiverOnAnEdge) {
  EXPECT_THAT(messageFor(squareAt(1.0), {{0.5, 0.25, 1.0}, -kUp}),
              AllOf(HasSubstr("on the edge from vertices[2]"), HasSubstr("[0.5, 0.25, 1]")));
}

TEST(EvaluatePolygon, RefusesDistancesBeyondTheRangeOfProducts) {
  Polygon square{"lamp", {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}, 1.0};
  EXPECT_THAT(messageFor(square, {{-1e-100, -1e-100, -1e-100}, kUp}), HasSubstr("vertices[0]"));
  EXPECT_THAT(messageFor(square, {{0.5, -1e-100, -1e-100}, kUp}), HasSubstr("edge from vertices[3]"));
  for (Vector3d& v : square.vertices) {
    v *= 1e-100;
  }
  EXPECT_THAT(messageFor(square, {{0.0, 0.0, -1.0}, kUp}), HasSubstr("area"));
}

TEST(EvaluatePolygon, RefusesNumbersThatUnderflowBesideOthers) {
  EXPECT_THAT(messageFor(squareAt(1e-160), {{0.1, 0.2, -1.0}, kUp}),
              AllOf(HasSubstr("polygons[3] \"lamp\""), HasSubstr("has a coordinate, or a vertex has one,"),
                    HasSubstr("beside one of 1: must be 0 or at least 2^-500 of the largest")));
  EXPECT_THAT(messageFor(squareAt(1.0), {{0.1, 0.2, -1.0}, Vector3d(1e-140, 0.0, 1.0)}),
              HasSubstr("component of its normal of magnitude 9.9999999999999998e-141 beside one of 1"));
  EXPECT_EQ(messageFor(squareAt(1e-150), {{0.1, 0.2, -1.0}, Vector3d(1e-130, 0.0, 1.0)}), "");
}

TEST(EvaluatePolygon, RefusesATiltedReceiverInsideThePolygon) {
  EXPECT_THAT(messageFor(squareAt(1.0), {{0.1, 0.2, 1.0}, Vector3d(0.6, 0.0, 0.8)}), HasSubstr("is inside it"));
}

TEST(EvaluatePolygon, RefusesResultsBeyondTheRangeOfDouble) {
  Polygon polygon = squareAt(1.0);
  for (Vector3d& v : polygon.vertices) {
    v *= 1e-200;
  }
  EXPECT_THAT(messageFor(polygon, {{0.0, 0.0, 0.0}, kUp}), HasSubstr("range of double"));
}

TEST(EvaluatePolygon, AreaRuleTakesOverContinuously) {
  // Either rule serves on both sides of the switch, within the sum of the two bounds.
  for (const double distance : {12.0, 14.0, 14.1, 14.2, 14.5, 15.0, 20.0}) {
    Polygon polygon = squareAt(distance);
    const Receiver receiver{{0.3, -0.1, 0.0}, Vector3d(0.6, 0.0, 0.8)};
    const Eigen::Vector3d gradient = productionCandidate().gradient({polygon, receiver});
    const Eigen::Vector3d plain = plainBoundaryCandidate().gradient({polygon, receiver});
    EXPECT_LT((gradient - plain).cwiseAbs().maxCoeff() / gradient.cwiseAbs().maxCoeff(), 1e-12) << distance;
  }
}

TEST(EvaluatePolygon, PassesTheFastChecks) {
  SuiteOptions options;
  options.inputs = 6;
  options.slow_oracles = false;
  options.knows_horizon = true;
  options.promises_extremes = true;
  for (const Verdict& verdict : checkAll(productionCandidate(), options)) {
    EXPECT_TRUE(verdict.passed) << describe(verdict);
  }
}

}  // namespace
}  // namespace irradiff
