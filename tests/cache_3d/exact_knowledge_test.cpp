#include "experiments/cache_3d/exact_knowledge.h"

#include "derivatives/error_metric/harmonic_mean_distance.h"
#include "derivatives/error_metric/record_estimator.h"
#include "derivatives/samples/sample_hemisphere.h"
#include "experiments/ray_casting/ray_caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace irradiff {
namespace {

const Receiver kReceiver{{0.05, 0.15, 0.0}, {0.0, 0.0, 1.0}};
constexpr double kBeside = 1e-6;

/// A lamp, half of it behind a grey board.
std::vector<Polygon> lampAndBoard() {
  return {{"lamp", {{-0.5, -0.5, 2.0}, {0.5, -0.5, 2.0}, {0.5, 0.5, 2.0}, {-0.5, 0.5, 2.0}}, 10.0},
          {"board", {{0.1, -0.7, 1.0}, {1.3, -0.6, 1.0}, {1.2, 0.8, 1.0}, {0.1, 0.9, 1.0}}, 0.2}};
}

/// From many samples.
RecordDerivatives sampled(const std::vector<Polygon>& polygons, std::string_view metric, double share) {
  const GridShape shape{512, 512};
  const auto description =
      std::ranges::find(errorMetricDescriptions(), metric, [](const ErrorMetricDescription& d) { return d.name; });
  const RecordEstimator estimator(*description, Stratification::kConcentric, shape, share);
  const SampleFrame frame{kReceiver.position, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  const auto cast_none = [](const Eigen::Vector3d&) { return RayHit{}; };
  HemisphereSamples samples =
      sampleHemisphere(Strata(Stratification::kConcentric, shape), SamplePattern::kCentred, 0, 0, frame, cast_none);
  RayCaster(polygons).from(frame).cast(samples);
  return estimator.estimate(samples);
}

double difference(const Eigen::Matrix2d& a, const Eigen::Matrix2d& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

TEST(ExactKnowledge, HasTheDerivativesOfTheScene) {
  const std::vector<Polygon> polygons = lampAndBoard();
  const IrradianceDerivatives<double> exact = SceneEvaluator(polygons).evaluate(kReceiver).derivatives;
  const RecordKnowledge known = ExactKnowledge(polygons).record(kReceiver, kBeside);
  EXPECT_EQ(known.irradiance, exact.irradiance.value);
  EXPECT_EQ(known.gradient, exact.gradient.value);
  EXPECT_EQ(known.rotational_gradient, exact.rotational_gradient.value);
  EXPECT_EQ(known.hessians[0].occlusion, exact.tangential_hessian.value);
  EXPECT_EQ(ExactKnowledge(polygons).truth(kReceiver, kBeside).irradiance, exact.irradiance.value);
}

TEST(ExactKnowledge, IsWhatManySamplesTendTo) {
  const std::vector<Polygon> polygons = lampAndBoard();
  const RecordKnowledge known = ExactKnowledge(polygons).record(kReceiver, kBeside);
  for (std::size_t i = 0; i < kRadianceShares.size(); ++i) {
    const double share = kRadianceShares[i];
    // Of 512 x 512 samples and, for the geometric one, of the 1024 of the knowledge: 0.4 % and 2 % here.
    EXPECT_LT(difference(known.hessians[i].radiometric,
                         sampled(polygons, "radiometric-hessian", share).tangential_hessian->value),
              0.02);
    EXPECT_LT(difference(known.hessians[i].geometric,
                         sampled(polygons, "geometric-hessian", share).tangential_hessian->value),
              0.05);
  }
  // Bad twin: the Hessian that knows of occlusion is another.
  EXPECT_GT(difference(known.hessians[0].occlusion, known.hessians[0].radiometric), 0.2);  // 0.49
  EXPECT_NEAR(known.harmonic_mean_distance, *sampled(polygons, "split-sphere", 0.0).harmonic_mean_distance,
              0.02 * known.harmonic_mean_distance);
}

TEST(ExactKnowledge, OfABlackRecordIsThatOfRadiance1) {
  std::vector<Polygon> polygons = lampAndBoard();
  for (Polygon& polygon : polygons) polygon.radiance = 0.0;
  const RecordKnowledge known = ExactKnowledge(polygons).record(kReceiver, kBeside);
  EXPECT_EQ(known.irradiance, 0.0);
  for (Polygon& polygon : polygons) polygon.radiance = 1.0;
  const IrradianceDerivatives<double> bright = SceneEvaluator(polygons).evaluate(kReceiver).derivatives;
  for (const MetricHessians& hessians : known.hessians) {
    EXPECT_EQ(hessians.irradiance, bright.irradiance.value);
    EXPECT_EQ(hessians.occlusion, bright.tangential_hessian.value);
    EXPECT_GT(hessians.radiometric.norm(), 0.0);
    EXPECT_GT(hessians.geometric.norm(), 0.0);
  }
}

TEST(ExactKnowledge, LooksBesideAReceiverThatHasEdgesInLine) {
  // The board's edge is seen exactly on the lamp's.
  std::vector<Polygon> polygons = lampAndBoard();
  polygons[1].vertices = {{-0.25, -1.0, 1.0}, {-0.25, 1.0, 1.0}, {-2.0, 1.0, 1.0}, {-2.0, -1.0, 1.0}};
  const Receiver receiver{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
  ASSERT_FALSE(SceneEvaluator(polygons).evaluate(receiver).no_gradient.empty());
  const RecordKnowledge known = ExactKnowledge(polygons).record(receiver, kBeside);
  EXPECT_TRUE(known.gradient.allFinite());
  EXPECT_THROW(ExactKnowledge(polygons).record(receiver, 0.0), InvalidScene);
}

TEST(ExactKnowledge, TellsWhatIsSeen) {
  std::vector<Polygon> polygons = lampAndBoard();
  EXPECT_EQ(ExactKnowledge(polygons).seenPolygons(kReceiver), (std::vector<bool>{true, true}));
  for (Eigen::Vector3d& vertex : polygons[1].vertices) vertex.x() -= 0.6;
  EXPECT_EQ(ExactKnowledge(polygons).seenPolygons(kReceiver), (std::vector<bool>{false, true}));
}

}  // namespace
}  // namespace irradiff
