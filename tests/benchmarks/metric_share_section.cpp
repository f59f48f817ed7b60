#include "tests/benchmarks/metric_share_section.h"

#include "derivatives/boundary/irradiance.h"
#include "derivatives/error_metric/harmonic_mean_distance.h"
#include "derivatives/error_metric/record_estimator.h"
#include "derivatives/error_metric/reprojection.h"
#include "derivatives/estimators/estimator.h"
#include "derivatives/samples/sample_hemisphere.h"
#include "derivatives/samples/strata.h"
#include "experiments/cache_3d/camera_view.h"
#include "experiments/cache_3d/direct_light.h"
#include "experiments/cache_3d/face_rays.h"
#include "experiments/cache_3d/known_geometry.h"
#include "experiments/cache_3d/metric_records.h"
#include "experiments/cache_3d/room.h"
#include "experiments/cache_3d/room_field.h"
#include "experiments/cache_3d/room_gather.h"
#include "tests/benchmarks/ratio_reporter.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iomanip>
#include <limits>
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
constexpr std::size_t kPixels = 5;
/// As wide an image as the error curves have: what sizes and thresholds are taken for.
constexpr std::size_t kWidth = 256;

/// One ray in each stratum; what it hits sends back what the lamps send there.
RoomSamples gatherExactly(const Room& room, const FaceRays& faces, const DirectLight& light, const SeenPoint& point) {
  const Receiver& receiver = point.receiver;
  const Eigen::Matrix<double, 3, 2> tangents = tangentFrame<double>(receiver.normal);
  const SampleFrame frame{receiver.position, tangents.col(0), tangents.col(1), receiver.normal};
  const Strata strata(Stratification::kConcentric, kShape);
  const auto cast_none = [](const Eigen::Vector3d&) { return RayHit{}; };
  HemisphereSamples samples = sampleHemisphere(strata, SamplePattern::kJittered, kSeed, point.pixel, frame, cast_none);
  faces.from(frame).cast(samples);
  const Eigen::Matrix3d axes = frame.axes();
  std::vector<std::size_t> hit_faces(samples.radiance.size(), kNoFace);
  for (std::size_t i = 0; i < samples.radiance.size(); ++i) {
    const std::optional<std::size_t> face = FaceRays::faceOf(samples.radiance[i]);
    samples.radiance[i] = 0.0;
    if (!face) continue;
    hit_faces[i] = *face;
    const std::vector<Eigen::Vector3d>& corners = room.polygons[*face].vertices;
    const Eigen::Vector3d direction = axes * samples.direction(i);
    Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    if (normal.dot(direction) > 0.0) normal = -normal;
    const Eigen::Vector3d hit = frame.position + direction / samples.inverse_distance[i];
    samples.radiance[i] = light.radiance(*face, {hit, normal});
  }
  return {std::move(samples), std::move(hit_faces)};
}

/// Of one call, of as many as it takes to fill two milliseconds.
double microseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  double elapsed = 0.0;
  std::size_t count = 0;
  while (elapsed < 0.002) {
    work();
    ++count;
    elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return 1e6 * elapsed / static_cast<double>(count);
}

double extentOf(const Room& room) {
  double extent = 0.0;
  for (const Polygon& polygon : room.polygons) {
    for (const Eigen::Vector3d& vertex : polygon.vertices) {
      extent = std::max(extent, (vertex - room.polygons.front().vertices.front()).cwiseAbs().maxCoeff());
    }
  }
  return extent;
}

/// Records that are made of gathers when they are asked for, each metric taking what it needs and no more.
class LazyRecords {
 public:
  LazyRecords(const Room& room, const std::vector<SeenPoint>& points, std::vector<RoomSamples> gathers)
      : gathers_(std::move(gathers)),
        strata_(Stratification::kConcentric, kShape),
        walls_(makeEstimator("ward-heckbert", Stratification::kConcentric, kShape)),
        errors_(Stratification::kConcentric, kShape, kRoomProfileDirections),
        geometry_(room.polygons, kShape) {
    for (const ErrorMetricDescription& metric : errorMetricDescriptions()) {
      if (!metric.takes_hessian) continue;
      hessians_.emplace_back(
          std::string(metric.name),
          std::make_unique<RecordEstimator>(metric, Stratification::kConcentric, kShape, kRadianceShares.back()));
    }
    const double last = extentOf(room);
    for (const SeenPoint& point : points) {
      receivers_.push_back(point.receiver);
      pixel_sizes_.push_back(point.pixel_size * static_cast<double>(kPixels) / static_cast<double>(kWidth));
      const double first = 0.5 * pixel_sizes_.back();
      std::vector<double>& distances = distances_.emplace_back();
      for (std::size_t m = 0; m < kRoomPredictedDistances; ++m) {
        distances.push_back(
            first * std::pow(last / first, static_cast<double>(m) / static_cast<double>(kRoomPredictedDistances - 1)));
      }
    }
    for (const RoomSamples& gathered : gathers_) {
      mean_irradiance_ += walls_->estimate(gathered.samples).irradiance / static_cast<double>(gathers_.size());
    }
  }

  /// Of one metric. Keeps this object. Not for several threads.
  RecordMaker maker(const std::string& metric, bool knows_geometry) {
    auto field = std::make_shared<FieldKnowledge>();
    field->receivers = receivers_;
    field->pixel_sizes = pixel_sizes_;
    field->offers_known_geometry = true;
    field->least_irradiance = kLeastIrradianceShare * mean_irradiance_;
    field->record = [this, metric, knows_geometry](std::size_t i) { return record(i, metric, knows_geometry); };
    field->reprojection = [this](std::size_t i) { return predict(i).profile(hiddenRadiance()); };
    field->predicted = [this](std::size_t i) -> RemainderAround {
      predict(i);
      return [this](const Eigen::Vector2d& step) { return predicted_.remainder(step); };
    };
    field->add_unseen = [this](std::size_t, ErrorProfile& profile) { predicted_.addHidden(hiddenRadiance(), profile); };
    field->profile_distances = [this](std::size_t i) { return distances_[i]; };
    field->profile_directions = kRoomProfileDirections;
    MetricChoice choice;
    choice.metric = metric;
    choice.knows_geometry = knows_geometry;
    choice.radiance_share = kRadianceShares.back();
    if (metric == "bounded-split-sphere") choice.largest_pixels = static_cast<double>(kWidth) / 12.0;
    // As the search for a number of records begins.
    const double pixel = median(pixel_sizes_);
    choice.threshold = metric.ends_with("split-sphere") ? 0.3 : 3.0 * pixel * pixel;
    return recordMaker(std::move(field), choice);
  }

 private:
  double hiddenRadiance() const { return std::numbers::inv_pi * mean_irradiance_; }

  const ReprojectedError& predict(std::size_t i) {
    predicted_ = errors_.predict(gathers_[i].samples, distances_[i]);
    return predicted_;
  }

  RecordKnowledge record(std::size_t i, const std::string& metric, bool knows_geometry) const {
    const HemisphereSamples& samples = gathers_[i].samples;
    RecordKnowledge known;
    if (knows_geometry) {
      known.known_geometry = geometry_.firstOrder(receivers_[i], gathers_[i]);
    } else {
      const IrradianceEstimate estimate = walls_->estimate(samples);
      const Eigen::Matrix3d axes = samples.frame.axes();
      known.irradiance = estimate.irradiance;
      known.gradient = axes * *estimate.gradient;
      known.rotational_gradient = axes * *estimate.rotational_gradient;
    }
    if (metric.ends_with("split-sphere")) known.harmonic_mean_distance = harmonicMeanDistance(samples, strata_);
    const std::string hessian = metric == "second-order" ? "occlusion-hessian" : metric;
    for (const auto& [name, estimator] : hessians_) {
      if (name != hessian) continue;
      const RecordDerivatives derivatives = estimator->estimate(samples);
      MetricHessians hessians;
      hessians.irradiance = derivatives.irradiance.value;
      hessians.radiometric = hessians.geometric = hessians.occlusion = derivatives.tangential_hessian->value;
      known.hessians.fill(hessians);
    }
    return known;
  }

  std::vector<RoomSamples> gathers_;
  std::vector<Receiver> receivers_;
  std::vector<double> pixel_sizes_;
  std::vector<std::vector<double>> distances_;
  double mean_irradiance_ = 0.0;
  Strata strata_;
  std::unique_ptr<Estimator> walls_;
  ReprojectedErrors errors_;
  KnownGeometry geometry_;
  std::vector<std::pair<std::string, std::unique_ptr<RecordEstimator>>> hessians_;
  ReprojectedError predicted_;  ///< of the record that was asked for last
};

/// A piece of work on each record, and its shortest time over rounds.
struct Cost {
  std::string what;
  std::function<void(std::size_t)> work;
  std::vector<double> times;  ///< us, of each record

  std::vector<double> percentOf(const Cost& whole) const {
    std::vector<double> percent;
    for (std::size_t i = 0; i < times.size(); ++i) percent.push_back(100.0 * times[i] / whole.times[i]);
    return percent;
  }
};

}  // namespace

void printMetricShareSection(std::ostream& out) {
  const Room room = readRoom(IRRADIFF_SCENE_FOLDER "/../rooms/cornell_box.json");
  const FaceRays faces(room.polygons);
  const DirectLight light(room);
  const SurfaceRadiance table = light.tabulated(1);
  const RoomGather by_table(room.polygons, table, kShape, kSeed);
  const std::vector<SeenPoint> points = seenPoints(room, kPixels);
  std::vector<RoomSamples> gathers;
  for (const SeenPoint& point : points) gathers.push_back(gatherExactly(room, faces, light, point));
  LazyRecords records(room, points, std::move(gathers));

  std::vector<Cost> costs;
  costs.push_back(
      {"gather, direct light exact at each hit",
       [&](std::size_t i) { benchmark::DoNotOptimize(gatherExactly(room, faces, light, points[i]).faces.data()); },
       {}});
  costs.push_back({"gather, direct light from a table",
                   [&](std::size_t i) {
                     benchmark::DoNotOptimize(by_table.gather(points[i].receiver, points[i].pixel).faces.data());
                   },
                   {}});
  const auto add = [&](const std::string& metric, bool knows_geometry) {
    costs.push_back({metric + (knows_geometry ? ", known geometry" : ""),
                     [maker = records.maker(metric, knows_geometry)](std::size_t i) {
                       benchmark::DoNotOptimize(maker(i).half_axes);
                     },
                     {}});
  };
  for (const std::string& metric : recordMetrics(true)) {
    if (metric != "oracle") add(metric, false);
  }
  add("second-order", true);
  for (Cost& cost : costs) cost.times.assign(points.size(), std::numeric_limits<double>::infinity());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (Cost& cost : costs) cost.times[i] = std::min(cost.times[i], microseconds([&] { cost.work(i); }));
    }
  }
  out << "\nCornell box, " << points.size() << " records of " << kShape.size()
      << " rays: what a metric takes besides the gather, gradients included. Shortest of " << kRounds
      << " rounds of each record; median (smallest .. largest) over records\n"
      << std::left << std::setw(42) << "what" << std::setw(32) << "microseconds" << std::setw(26)
      << "% of gather (asked: 3)"
      << "% of gather from a table\n";
  for (const Cost& cost : costs) {
    out << std::setw(42) << cost.what << std::setw(32) << spread(cost.times, 0) << std::setw(26)
        << spread(cost.percentOf(costs[0]), 2) << spread(cost.percentOf(costs[1]), 1) << '\n';
  }
  out << std::flush;
}

}  // namespace irradiff
