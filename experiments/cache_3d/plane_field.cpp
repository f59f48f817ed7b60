#include "experiments/cache_3d/plane_field.h"

#include "derivatives/error_metric/error_profile.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "experiments/cache_3d/exact_knowledge.h"
#include "experiments/cache_3d/knowledge_numbers.h"
#include "experiments/cache_3d/metric_records.h"
#include "experiments/cache_3d/sampled_knowledge.h"
#include "experiments/cache_3d/true_irradiance.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace irradiff {
namespace {

/// Of a pixel: where derivatives are taken if they do not exist at a receiver.
constexpr double kBeside = 0x1p-20;

constexpr std::size_t kProfileNumbers = kPlaneProfileDirections * kPlaneProfileDistances;
constexpr std::size_t kReprojectedNumbers = kProfileNumbers + 2 * kPlaneProfileDirections;
constexpr std::size_t kTruthNumbers = 5;

std::vector<double> profileDistances(const ReceiverGrid& grid, double pixel_size) {
  const double longest = std::hypot(grid.u.norm(), grid.v.norm());
  std::vector<double> distances;
  for (std::size_t m = 0; m < kPlaneProfileDistances; ++m) {
    const double share = static_cast<double>(m) / static_cast<double>(kPlaneProfileDistances - 1);
    distances.push_back(pixel_size * std::pow(longest / pixel_size, share));
  }
  return distances;
}

/// What a receiver without light knows: the polygons that it sees are black, and behind them, as far away as makes no
/// difference, there may be anything. Of radiance `irradiance`/pi, it has none here and is seen beside its polygon from
/// elsewhere.
std::vector<Polygon> withShadows(std::span<const Polygon> polygons, const std::vector<bool>& seen,
                                 const Eigen::Vector3d& position, double irradiance) {
  constexpr double kFarther = 1024.0;
  std::vector<Polygon> result;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (!seen[i]) continue;
    result.push_back(polygons[i]);
    Polygon shadow = polygons[i];
    for (Eigen::Vector3d& vertex : shadow.vertices) vertex = position + kFarther * (vertex - position);
    shadow.radiance = irradiance * std::numbers::inv_pi;
    result.push_back(std::move(shadow));
  }
  return result;
}

/// All that is known of the plane; receivers by the numbers of the grid, row-major from its origin.
class Plane {
 public:
  Plane(const FigureScene& scene, const PlaneFieldPlan& plan)
      : grid_(withResolution(*scene.scene.grid, plan.resolution)),
        pixel_size_(std::sqrt(grid_.u.norm() * grid_.v.norm() / static_cast<double>(grid_.width * grid_.height))),
        distances_(profileDistances(grid_, pixel_size_)),
        exact_(scene.scene.polygons),
        once_(new std::once_flag[grid_.width * grid_.height]) {
    if (plan.rays > 0) {
      sampled_.emplace(scene.scene.polygons, plan.rays, plan.seed, kPlaneProfileDirections);
    }
  }

  const ReceiverGrid& grid() const { return grid_; }
  double pixelSize() const { return pixel_size_; }
  std::size_t rays() const { return sampled_ ? sampled_->rays() : 0; }
  const TrueIrradiance& truth() const { return *truth_; }
  double referenceError() const { return reference_error_; }
  double leastIrradiance() const { return kLeastIrradianceShare * mean_irradiance_; }
  const RecordKnowledge& record(std::size_t i) const { return records_[i]; }

  void gather(unsigned threads, const TileStore* finished,
              const std::function<void(std::size_t, std::size_t)>& progress);

  ErrorProfile oracle(std::size_t i) const {
    return profile(i, [this](const Eigen::Vector3d& position) { return truth_->at(position); });
  }

  /// What the record's own samples, or the polygons that it sees, say.
  ErrorProfile reprojection(std::size_t i) const {
    if (sampled_) {
      static const double lambda = getenv("LAMBDA") ? atof(getenv("LAMBDA")) : 1.0;
      return reprojected_[i].profile(lambda * std::numbers::inv_pi * mean_irradiance_);
    }
    std::call_once(once_[i], [&] { predicted_[i] = predictedProfile(i); });
    const auto& errors = predicted_[i];
    return errors ? ErrorProfile{distances_, *errors} : oracle(i);
  }

 private:
  std::size_t numbersOfReceiver() const {
    return kTruthNumbers + kKnowledgeNumbers + (sampled_ ? kReprojectedNumbers : 0);
  }

  std::vector<double> gatherRow(std::size_t row) const;

  template <class IrradianceAt>
  ErrorProfile profile(std::size_t i, const IrradianceAt& irradianceAt) const;

  /// Without samples; nothing where it is the truth, all polygons being seen.
  std::optional<std::vector<float>> predictedProfile(std::size_t i) const;

  const SceneEvaluator& evaluatorOf(const std::vector<bool>& polygons) const;

  ReceiverGrid grid_;
  double pixel_size_;
  std::vector<double> distances_;
  ExactKnowledge exact_;
  std::optional<SampledKnowledge> sampled_;
  std::optional<TrueIrradiance> truth_;
  double reference_error_ = 0.0;
  double mean_irradiance_ = 0.0;  ///< of all receivers
  std::vector<RecordKnowledge> records_;
  std::vector<ReprojectedError> reprojected_;  ///< with samples
  std::unique_ptr<std::once_flag[]> once_;     ///< without, of the following
  mutable std::vector<std::optional<std::vector<float>>> predicted_;
  mutable std::mutex mutex_;  ///< of the following
  mutable std::map<std::vector<bool>, SceneEvaluator> of_seen_polygons_;
};

std::vector<double> Plane::gatherRow(std::size_t row) const {
  std::vector<double> numbers;
  numbers.reserve(grid_.width * numbersOfReceiver());
  for (std::size_t i = 0; i < grid_.width; ++i) {
    const Receiver receiver = grid_.receiver(i, row);
    const double beside = kBeside * pixel_size_;
    const PointTruth truth = exact_.truth(receiver, beside);
    numbers.insert(numbers.end(), {truth.irradiance, truth.irradiance_bound, truth.gradient.x(), truth.gradient.y(),
                                   truth.gradient.z()});
    if (!sampled_) {
      appendNumbers(exact_.record(receiver, beside), numbers);
      continue;
    }
    const SampledKnowledge::Gather gather = sampled_->gather(receiver, row * grid_.width + i, distances_);
    appendNumbers(gather.record, numbers);
    const ReprojectedError& error = gather.reprojection;
    numbers.insert(numbers.end(), error.seen.errors.begin(), error.seen.errors.end());
    numbers.insert(numbers.end(), error.hidden.begin(), error.hidden.end());
    numbers.insert(numbers.end(), error.free_distances.begin(), error.free_distances.end());
  }
  return numbers;
}

void Plane::gather(unsigned threads, const TileStore* finished,
                   const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::size_t count = grid_.width * grid_.height;
  std::vector<double> values(count);
  std::vector<double> bounds(count);
  std::vector<Eigen::Vector3d> gradients(count);
  records_.resize(count);
  if (sampled_) {
    reprojected_.resize(count);
  } else {
    predicted_.resize(count);
  }
  std::vector<std::function<void()>> rows;
  for (std::size_t row = 0; row < grid_.height; ++row) {
    rows.emplace_back([&, row] {
      std::optional<std::vector<double>> tile;
      if (finished != nullptr) tile = finished->read(row, grid_.width * numbersOfReceiver());
      if (!tile) {
        tile = gatherRow(row);
        if (finished != nullptr) finished->write(row, *tile);
      }
      const double* from = tile->data();
      for (std::size_t k = row * grid_.width; k < (row + 1) * grid_.width; ++k) {
        values[k] = from[0];
        bounds[k] = from[1];
        gradients[k] = {from[2], from[3], from[4]};
        records_[k] = knowledgeOf(std::span<const double, kKnowledgeNumbers>(from + kTruthNumbers, kKnowledgeNumbers));
        if (sampled_) {
          const double* errors = from + kTruthNumbers + kKnowledgeNumbers;
          const double* hidden = errors + kProfileNumbers;
          const double* free_distances = hidden + kPlaneProfileDirections;
          reprojected_[k] = {{distances_, std::vector<float>(errors, hidden)},
                             std::vector<float>(hidden, free_distances),
                             std::vector<double>(free_distances, free_distances + kPlaneProfileDirections)};
        }
        from += numbersOfReceiver();
      }
    });
  }
  runTasks(rows, threads, progress);
  mean_irradiance_ = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(count);
  truth_.emplace(grid_, std::move(values), std::move(gradients));
  const double squares = std::inner_product(bounds.begin(), bounds.end(), bounds.begin(), 0.0);
  reference_error_ = std::sqrt(squares / static_cast<double>(count));
}

template <class IrradianceAt>
ErrorProfile Plane::profile(std::size_t i, const IrradianceAt& irradianceAt) const {
  const Receiver receiver = grid_.receiver(i % grid_.width, i / grid_.width);
  const Eigen::Matrix<double, 3, 2> tangents = tangentFrame<double>(receiver.normal);
  const RecordKnowledge& known = records_[i];
  ErrorProfile profile;
  profile.distances = distances_;
  profile.errors.reserve(kProfileNumbers);
  for (std::size_t k = 0; k < kPlaneProfileDirections; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / kPlaneProfileDirections;
    const Eigen::Vector3d along = tangents * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    for (const double distance : distances_) {
      const Eigen::Vector3d step = distance * along;
      const std::optional<double> there = irradianceAt(receiver.position + step);
      const double error = there ? std::abs(*there - known.irradiance - known.gradient.dot(step)) : 0.0;
      profile.errors.push_back(static_cast<float>(error));
    }
  }
  return profile;
}

std::optional<std::vector<float>> Plane::predictedProfile(std::size_t i) const {
  const Receiver receiver = grid_.receiver(i % grid_.width, i / grid_.width);
  const std::vector<bool> seen = exact_.seenPolygons(receiver);
  const auto errorsIn = [&](const SceneEvaluator& evaluator) {
    return profile(i,
                   [&](const Eigen::Vector3d& position) -> std::optional<double> {
                     if (!truth_->at(position)) return std::nullopt;
                     try {
                       return evaluator.evaluate({position, receiver.normal}).derivatives.irradiance.value;
                     } catch (const InvalidScene&) {
                       return std::nullopt;  // On an edge of a polygon: there is no receiver.
                     }
                   })
        .errors;
  };
  if (records_[i].irradiance == 0.0) {
    return errorsIn(SceneEvaluator(withShadows(exact_.polygons(), seen, receiver.position, leastIrradiance())));
  }
  if (std::ranges::all_of(seen, [](bool is_seen) { return is_seen; })) return std::nullopt;
  return errorsIn(evaluatorOf(seen));
}

const SceneEvaluator& Plane::evaluatorOf(const std::vector<bool>& polygons) const {
  const std::scoped_lock lock(mutex_);
  const auto found = of_seen_polygons_.find(polygons);
  if (found != of_seen_polygons_.end()) return found->second;
  std::vector<Polygon> seen;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (polygons[i]) seen.push_back(exact_.polygons()[i]);
  }
  return of_seen_polygons_.emplace(polygons, SceneEvaluator(seen)).first->second;
}

void require(const FigureScene& scene, const PlaneFieldPlan& plan) {
  const ReceiverGrid grid = withResolution(*scene.scene.grid, plan.resolution);
  if (grid.width < 2 || grid.height < 2) {
    throw std::invalid_argument(scene.name + ": the plane has " + std::to_string(grid.width) + " x " +
                                std::to_string(grid.height) + " receivers, must have 2 at least along each side");
  }
  if (plan.rays > 0 && plan.rays < 4) {
    throw std::invalid_argument(scene.name + ": " + std::to_string(plan.rays) +
                                " rays for a record, must be 0 (exact) or 4 at least");
  }
}

}  // namespace

std::string planeFieldFingerprint(const FigureScene& scene, const PlaneFieldPlan& plan) {
  return "plane " + std::to_string(plan.resolution) + ' ' + std::to_string(plan.rays) + ' ' +
         std::to_string(plan.seed) + ' ' + scene.text;
}

RecordField planeField(const FigureScene& scene, const PlaneFieldPlan& plan, const TileStore* finished,
                       const std::function<void(std::size_t, std::size_t)>& progress) {
  require(scene, plan);
  const auto plane = std::make_shared<Plane>(scene, plan);
  plane->gather(plan.threads, finished, progress);

  RecordField field;
  field.name = scene.name;
  const ReceiverGrid& grid = plane->grid();
  field.width = grid.width;
  field.height = grid.height;
  field.reference_error = plane->referenceError();
  field.rays_per_record = plane->rays();
  field.metrics = recordMetrics();
  // Upright: from the last row to the first.
  const auto inGrid = [width = grid.width, height = grid.height](std::size_t pixel) {
    return (height - 1 - pixel / width) * width + pixel % width;
  };
  const auto knowledge = std::make_shared<FieldKnowledge>();
  for (std::size_t pixel = 0; pixel < grid.width * grid.height; ++pixel) {
    const std::size_t k = inGrid(pixel);
    field.pixels.push_back(pixel);
    field.receivers.push_back(grid.receiver(k % grid.width, k / grid.width));
    field.faces.push_back(0);
    field.reference.push_back(plane->truth().values()[k]);
    field.pixel_sizes.push_back(plane->pixelSize());
  }
  if (!(plane->leastIrradiance() > 0.0)) {
    throw std::invalid_argument(scene.name + ": no receiver of the grid has any light, some must");
  }
  knowledge->receivers = field.receivers;
  knowledge->pixel_sizes = field.pixel_sizes;
  knowledge->least_irradiance = plane->leastIrradiance();
  knowledge->record = [plane, inGrid](std::size_t pixel) { return plane->record(inGrid(pixel)); };
  knowledge->reprojection = [plane, inGrid](std::size_t pixel) { return plane->reprojection(inGrid(pixel)); };
  knowledge->oracle = [plane, inGrid](std::size_t pixel) { return plane->oracle(inGrid(pixel)); };
  field.records = [knowledge](const MetricChoice& choice) { return recordMaker(knowledge, choice); };
  field.true_error = trueError(knowledge);
  return field;
}

}  // namespace irradiff
