#include "tests/benchmarks/metric_share_section.h"

#include "derivatives/boundary/irradiance.h"
#include "derivatives/error_metric/error_profile.h"
#include "derivatives/error_metric/reprojection.h"
#include "derivatives/estimators/estimator.h"
#include "derivatives/samples/sample_hemisphere.h"
#include "experiments/cache_3d/camera_view.h"
#include "experiments/cache_3d/direct_light.h"
#include "experiments/cache_3d/face_rays.h"
#include "experiments/cache_3d/room.h"
#include "tests/benchmarks/ratio_reporter.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <memory>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 2012;
constexpr int kRounds = 5;
constexpr GridShape kShape{64, 64};
/// Pixels along a side of the camera's image, each of them a record.
constexpr std::size_t kPixels = 4;

/// One ray in each stratum; what it hits sends back what the lamps send there.
HemisphereSamples gather(const Room& room, const FaceRays& faces, const DirectLight& light, const SeenPoint& point) {
  const Receiver& receiver = point.receiver;
  const Eigen::Matrix<double, 3, 2> tangents = tangentFrame<double>(receiver.normal);
  const SampleFrame frame{receiver.position, tangents.col(0), tangents.col(1), receiver.normal};
  const Strata strata(Stratification::kConcentric, kShape);
  const auto cast_none = [](const Eigen::Vector3d&) { return RayHit{}; };
  HemisphereSamples samples = sampleHemisphere(strata, SamplePattern::kJittered, kSeed, point.pixel, frame, cast_none);
  faces.from(frame).cast(samples);
  const Eigen::Matrix3d axes = frame.axes();
  for (std::size_t i = 0; i < samples.radiance.size(); ++i) {
    const std::optional<std::size_t> face = FaceRays::faceOf(samples.radiance[i]);
    samples.radiance[i] = 0.0;
    if (!face) continue;
    const std::vector<Eigen::Vector3d>& corners = room.polygons[*face].vertices;
    const Eigen::Vector3d direction = axes * samples.direction(i);
    Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    if (normal.dot(direction) > 0.0) normal = -normal;
    const Eigen::Vector3d hit = frame.position + direction / samples.inverse_distance[i];
    samples.radiance[i] = light.radiance(*face, {hit, normal});
  }
  return samples;
}

/// Of one record, all of them being worked on as often as it takes to fill a twentieth of a second.
template <class Record, class Work>
double microseconds(const std::vector<Record>& records, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  double elapsed = 0.0;
  std::size_t count = 0;
  while (elapsed < 0.05) {
    for (const Record& record : records) work(record);
    count += records.size();
    elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return 1e6 * elapsed / static_cast<double>(count);
}

}  // namespace

void printMetricShareSection(std::ostream& out) {
  const Room room = readRoom(IRRADIFF_SCENE_FOLDER "/../rooms/cornell_box.json");
  const FaceRays faces(room.polygons);
  const DirectLight light(room);
  const std::vector<SeenPoint> points = seenPoints(room, kPixels);
  std::vector<HemisphereSamples> records;
  for (const SeenPoint& point : points) records.push_back(gather(room, faces, light, point));

  const std::unique_ptr<Estimator> gradients = makeEstimator("ward-heckbert", Stratification::kConcentric, kShape);
  const ReprojectedErrors errors(Stratification::kConcentric, kShape);
  std::vector<double> distances;
  for (int m = 0; m < 10; ++m) distances.push_back(0.005 * std::pow(1.8, m));
  std::vector<ErrorProfile> profiles;
  for (const HemisphereSamples& samples : records) profiles.push_back(errors.profile(samples, distances, 0.1));

  struct Cost {
    std::string what;
    std::vector<double> times, percent;
  };
  std::vector<Cost> costs{{"gather", {}, {}}, {"gradients", {}, {}}, {"reprojection", {}, {}}, {"ellipse", {}, {}}};
  for (int round = 0; round < kRounds; ++round) {
    costs[0].times.push_back(microseconds(points, [&](const SeenPoint& point) {
      benchmark::DoNotOptimize(gather(room, faces, light, point).radiance.data());
    }));
    costs[1].times.push_back(microseconds(
        records, [&](const HemisphereSamples& samples) { benchmark::DoNotOptimize(gradients->estimate(samples)); }));
    costs[2].times.push_back(microseconds(records, [&](const HemisphereSamples& samples) {
      benchmark::DoNotOptimize(errors.profile(samples, distances, 0.1).errors.data());
    }));
    costs[3].times.push_back(microseconds(profiles, [&](const ErrorProfile& profile) {
      benchmark::DoNotOptimize(largestEllipse(profile, {1.0}, 1e-3, {}, 0.005, 1.0));
    }));
    for (Cost& cost : costs) cost.percent.push_back(100.0 * cost.times.back() / costs[0].times.back());
  }
  out << "\nCornell box, " << records.size() << " records of " << kShape.size()
      << " rays with exact direct light at each hit, microseconds for a record, median (smallest .. largest) over "
      << kRounds << " rounds\n"
      << std::left << std::setw(44) << "what" << std::setw(30) << "microseconds"
      << "% of gather (asked: at most 3 in sum)\n";
  for (const Cost& cost : costs) {
    out << std::setw(44) << cost.what << std::setw(30) << spread(cost.times, 1) << spread(cost.percent, 2) << '\n';
  }
  out << std::flush;
}

}  // namespace irradiff
