// Gathers in rooms, and what is evaluated of them at once against the estimators one by one.

#include "experiments/cache_3d/gather_evaluation.h"

#include "derivatives/error_metric/record_estimator.h"
#include "derivatives/estimators/estimator.h"
#include "experiments/cache_3d/camera_view.h"
#include "experiments/cache_3d/room_gather.h"
#include "tests/cache_3d/test_rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace irradiff {
namespace {

constexpr GridShape kShape{16, 16};

SurfaceRadiance someRadiance(const Room& room) {
  return {room.polygons, 0.1,
          [](std::size_t face, const Eigen::Vector3d& p, const Eigen::Vector3d&) {
            return static_cast<double>(face % 4) + 0.3 * p.x() + 0.2 * p.y() * p.z();
          },
          1};
}

TEST(GatherShape, IsASquare) {
  EXPECT_EQ(gatherShape(4096), (GridShape{64, 64}));
  EXPECT_EQ(gatherShape(4), (GridShape{2, 2}));
  for (const std::size_t rays : {0, 1, 2, 1000}) {
    EXPECT_THAT([rays] { gatherShape(rays); },
                testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr(std::to_string(rays) + " rays")));
  }
}

TEST(RoomGather, SeesTheRadianceOfWhatItsRaysHit) {
  const Room room = dataRoom("cornell_box");
  const SurfaceRadiance radiance = someRadiance(room);
  const RoomGather gather(room.polygons, radiance, kShape, 3);
  std::vector<Polygon> named = room.polygons;
  const FaceRays faces(room.polygons);
  std::size_t hits = 0;
  std::size_t misses = 0;
  for (const SeenPoint& point : seenPoints(room, 9)) {
    const HemisphereSamples samples = gather.gather(point.receiver, point.pixel).samples;
    ASSERT_EQ(samples.radiance.size(), kShape.size());
    const ReceiverRays rays = faces.from(samples.frame);
    for (std::size_t i = 0; i < samples.radiance.size(); ++i) {
      const RayHit hit = rays.cast(samples.direction(i));
      EXPECT_EQ(hit.inverse_distance, samples.inverse_distance[i]);
      const std::optional<std::size_t> face = FaceRays::faceOf(hit.radiance);
      if (!face) {
        EXPECT_EQ(samples.radiance[i], 0.0);
        ++misses;
        continue;
      }
      ++hits;
      const Eigen::Vector3d position =
          samples.frame.position + samples.frame.axes() * samples.direction(i) / hit.inverse_distance;
      EXPECT_NEAR(samples.radiance[i], radiance.at(*face, position, point.receiver.position), 1e-12);
    }
  }
  EXPECT_GT(hits, 1000U);
  EXPECT_GT(misses, 100U) << "the box is open in front";
}

TEST(RoomGather, DependsOnSeedAndPointAlone) {
  const Room room = dataRoom("indirect_penumbra");
  const SurfaceRadiance radiance = someRadiance(room);
  const RoomGather gather(room.polygons, radiance, kShape, 3);
  const Receiver receiver{{1.0, 1.2, 0.0}, {0, 0, 1}};
  EXPECT_EQ(gather.gather(receiver, 7).samples.radiance, gather.gather(receiver, 7).samples.radiance);
  EXPECT_NE(gather.gather(receiver, 7).samples.direction_t, gather.gather(receiver, 8).samples.direction_t);
  EXPECT_NE(gather.gather(receiver, 7).samples.direction_t,
            RoomGather(room.polygons, radiance, kShape, 4).gather(receiver, 7).samples.direction_t);
}

RecordDerivatives estimated(std::string_view metric, const HemisphereSamples& samples, double share) {
  const auto description =
      std::ranges::find(errorMetricDescriptions(), metric, [](const ErrorMetricDescription& d) { return d.name; });
  return RecordEstimator(*description, Stratification::kConcentric, kShape, share).estimate(samples);
}

double relativeDifference(const Eigen::Matrix2d& found, const RecordDerivatives& expected) {
  const Eigen::Matrix2d& hessian = expected.tangential_hessian->value;
  return (found - 0.5 * (hessian + hessian.transpose())).cwiseAbs().maxCoeff() / hessian.cwiseAbs().maxCoeff();
}

void expectAsEstimated(const HemisphereSamples& samples) {
  const GatherEvaluation evaluation(kShape, 8);
  const RecordKnowledge known = evaluation.knowledge(samples);
  const IrradianceEstimate walls =
      makeEstimator("ward-heckbert", Stratification::kConcentric, kShape)->estimate(samples);
  EXPECT_EQ(known.irradiance, walls.irradiance);
  EXPECT_EQ(known.gradient, samples.frame.axes() * *walls.gradient);
  EXPECT_EQ(known.rotational_gradient, samples.frame.axes() * *walls.rotational_gradient);
  EXPECT_EQ(known.harmonic_mean_distance, *estimated("split-sphere", samples, 0.0).harmonic_mean_distance);
  for (std::size_t i = 0; i < kRadianceShares.size(); ++i) {
    const double share = kRadianceShares[i];
    const MetricHessians& hessians = known.hessians[i];
    const RecordDerivatives occlusion = estimated("occlusion-hessian", samples, share);
    EXPECT_NEAR(hessians.irradiance, occlusion.irradiance.value, 1e-13 * occlusion.irradiance.value);
    // Sums of 256 terms that partly cancel: 256 roundings of a size up to 50 times the sum's.
    constexpr double kRounding = 256 * 50 * 0x1p-53;
    EXPECT_LT(relativeDifference(hessians.occlusion, occlusion), kRounding);
    EXPECT_LT(relativeDifference(hessians.radiometric, estimated("radiometric-hessian", samples, share)), kRounding);
    EXPECT_LT(relativeDifference(hessians.geometric, estimated("geometric-hessian", samples, share)), kRounding);
    // Bad twin: the other share.
    const double other = kRadianceShares[1 - i];
    const bool is_black = known.irradiance == 0.0;
    EXPECT_EQ(relativeDifference(hessians.geometric, estimated("geometric-hessian", samples, other)) > kRounding,
              !is_black);
  }
}

TEST(GatherEvaluation, IsWhatTheEstimatorsSay) {
  const Room room = dataRoom("cornell_box");
  const SurfaceRadiance radiance = someRadiance(room);
  const RoomGather gather(room.polygons, radiance, kShape, 3);
  for (const SeenPoint& point : seenPoints(room, 7))
    expectAsEstimated(gather.gather(point.receiver, point.pixel).samples);
}

TEST(GatherEvaluation, TakesRadianceOneInTheDark) {
  const Room room = dataRoom("cornell_box");
  const SurfaceRadiance dark(
      room.polygons, 0.5, [](std::size_t, const Eigen::Vector3d&, const Eigen::Vector3d&) { return 0.0; }, 1);
  const HemisphereSamples samples =
      RoomGather(room.polygons, dark, kShape, 3).gather({{0.3, 0.2, 0}, {0, 0, 1}}, 0).samples;
  expectAsEstimated(samples);
  const GatherEvaluation evaluation(kShape, 8);
  EXPECT_EQ(evaluation.knowledge(samples).irradiance, 0.0);
  const std::vector<double> distances{0.1, 0.3};
  const ErrorProfile profile = evaluation.reprojection(samples, distances).profile(1.0);
  EXPECT_GT(*std::ranges::max_element(profile.errors), 0.0F);
}

}  // namespace
}  // namespace irradiff
