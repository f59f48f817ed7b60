#include "experiments/cache_3d/plane_knowledge.h"

#include "derivatives/scene/invalid_scene.h"
#include "experiments/cache_3d/knowledge_numbers.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

namespace irradiff {
namespace {

/// Of a pixel: where derivatives are taken if they do not exist at a receiver.
constexpr double kBeside = 0x1p-20;

constexpr std::size_t kReprojectedNumbers = reprojectionNumbers(kPlaneProfileDirections, kPlaneProfileDistances);
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

}  // namespace

PlaneKnowledge::PlaneKnowledge(const FigureScene& scene, const PlaneFieldPlan& plan)
    : grid_(withResolution(*scene.scene.grid, plan.resolution)),
      pixel_size_(std::sqrt(grid_.u.norm() * grid_.v.norm() / static_cast<double>(grid_.width * grid_.height))),
      distances_(profileDistances(grid_, pixel_size_)),
      exact_(scene.scene.polygons),
      once_(new std::once_flag[grid_.width * grid_.height]) {
  if (plan.rays > 0) {
    sampled_.emplace(scene.scene.polygons, plan.rays, plan.seed, kPlaneProfileDirections);
  }
}

std::size_t PlaneKnowledge::numbersOfReceiver() const {
  return kTruthNumbers + kKnowledgeNumbers + (sampled_ ? kReprojectedNumbers : 0);
}

std::vector<double> PlaneKnowledge::gatherRow(std::size_t row) const {
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
    appendNumbers(gather.reprojection, numbers);
  }
  return numbers;
}

void PlaneKnowledge::gather(unsigned threads, const TileStore* finished,
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
          reprojected_[k] = reprojectedErrorOf({from + kTruthNumbers + kKnowledgeNumbers, kReprojectedNumbers},
                                               kPlaneProfileDirections, distances_);
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

IrradianceAround PlaneKnowledge::truthAround(std::size_t i) const {
  const Receiver here = receiver(i);
  return [this, here, tangents = tangentFrame<double>(here.normal)](const Eigen::Vector2d& step) {
    return truth_->at(here.position + tangents * step);
  };
}

ErrorProfile PlaneKnowledge::errorsOfRecord(std::size_t i, const IrradianceAround& irradiance) const {
  const RecordKnowledge& known = records_[i];
  const Eigen::Matrix<double, 3, 2> tangents = tangentFrame<double>(grid_.normal);
  return errorsOf({known.irradiance, tangents.transpose() * known.gradient}, irradiance, distances_,
                  kPlaneProfileDirections);
}

ErrorProfile PlaneKnowledge::oracle(std::size_t i) const { return errorsOfRecord(i, truthAround(i)); }

IrradianceAround PlaneKnowledge::predictedAround(std::size_t i) const {
  const Receiver here = receiver(i);
  const std::vector<bool> seen = exact_.seenPolygons(here);
  const bool is_black = records_[i].irradiance == 0.0;
  if (!is_black && std::ranges::all_of(seen, [](bool is_seen) { return is_seen; })) return truthAround(i);
  std::shared_ptr<const SceneEvaluator> feared;
  if (is_black) {
    feared = std::make_shared<SceneEvaluator>(withShadows(exact_.polygons(), seen, here.position, mean_irradiance_));
  }
  const SceneEvaluator* const evaluator = is_black ? feared.get() : &evaluatorOf(seen);
  return [this, here, feared, evaluator,
          tangents = tangentFrame<double>(here.normal)](const Eigen::Vector2d& step) -> std::optional<double> {
    const Eigen::Vector3d position = here.position + tangents * step;
    if (!truth_->at(position)) return std::nullopt;
    try {
      return evaluator->evaluate({position, here.normal}).derivatives.irradiance.value;
    } catch (const InvalidScene&) {
      return std::nullopt;  // On an edge of a polygon: there is no receiver.
    }
  };
}

ErrorProfile PlaneKnowledge::reprojection(std::size_t i) const {
  if (sampled_) return reprojected_[i].profile(std::numbers::inv_pi * mean_irradiance_);
  std::call_once(once_[i], [&] { predicted_[i] = errorsOfRecord(i, predictedAround(i)); });
  return predicted_[i];
}

RemainderAround PlaneKnowledge::remainderAround(std::size_t i) const {
  if (sampled_) return [&error = reprojected_[i]](const Eigen::Vector2d& step) { return error.remainder(step); };
  const RecordKnowledge& known = records_[i];
  const Eigen::Vector2d gradient = tangentFrame<double>(grid_.normal).transpose() * known.gradient;
  return [predicted = predictedAround(i), irradiance = known.irradiance,
          gradient](const Eigen::Vector2d& step) -> std::optional<double> {
    const std::optional<double> there = predicted(step);
    if (!there) return std::nullopt;
    return *there - irradiance - gradient.dot(step);
  };
}

void PlaneKnowledge::addUnseen(std::size_t i, ErrorProfile& errors) const {
  if (sampled_) reprojected_[i].addHidden(std::numbers::inv_pi * mean_irradiance_, errors);
}

const SceneEvaluator& PlaneKnowledge::evaluatorOf(const std::vector<bool>& polygons) const {
  const std::scoped_lock lock(mutex_);
  const auto found = of_seen_polygons_.find(polygons);
  if (found != of_seen_polygons_.end()) return found->second;
  std::vector<Polygon> seen;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (polygons[i]) seen.push_back(exact_.polygons()[i]);
  }
  return of_seen_polygons_.emplace(polygons, SceneEvaluator(seen)).first->second;
}

}  // namespace irradiff
