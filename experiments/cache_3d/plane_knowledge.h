#pragma once

#include "derivatives/error_metric/error_profile.h"
#include "derivatives/error_metric/reprojection.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "experiments/cache_3d/exact_knowledge.h"
#include "experiments/cache_3d/metric_records.h"
#include "experiments/cache_3d/plane_field.h"
#include "experiments/cache_3d/sampled_knowledge.h"
#include "experiments/cache_3d/second_order.h"
#include "experiments/cache_3d/true_irradiance.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace irradiff {

/// What planeField knows of its receivers, by the numbers of the grid, row-major from its origin. After `gather` it may
/// be asked from several threads at once, as long as it lives.
class PlaneKnowledge {
 public:
  PlaneKnowledge(const FigureScene& scene, const PlaneFieldPlan& plan);

  /// As planeField for threads, finished rows and progress. Once, before anything below is asked but the grid.
  void gather(unsigned threads, const TileStore* finished,
              const std::function<void(std::size_t, std::size_t)>& progress);

  const ReceiverGrid& grid() const { return grid_; }
  double pixelSize() const { return pixel_size_; }
  const std::vector<double>& distances() const { return distances_; }  ///< of profiles; m
  bool isSampled() const { return sampled_.has_value(); }
  std::size_t rays() const { return sampled_ ? sampled_->rays() : 0; }

  const TrueIrradiance& truth() const { return *truth_; }
  double referenceError() const { return reference_error_; }
  double meanIrradiance() const { return mean_irradiance_; }
  const RecordKnowledge& record(std::size_t i) const { return records_[i]; }

  IrradianceAround truthAround(std::size_t i) const;
  ErrorProfile oracle(std::size_t i) const;

  /// Without samples: by the polygons of which the record sees some part, or by what a black record fears.
  IrradianceAround predictedAround(std::size_t i) const;
  RemainderAround remainderAround(std::size_t i) const;
  ErrorProfile reprojection(std::size_t i) const;
  /// Adds to errors of a record with samples what it does not see.
  void addUnseen(std::size_t i, ErrorProfile& errors) const;

 private:
  std::size_t numbersOfReceiver() const;
  std::vector<double> gatherRow(std::size_t row) const;
  Receiver receiver(std::size_t i) const { return grid_.receiver(i % grid_.width, i / grid_.width); }
  ErrorProfile errorsOfRecord(std::size_t i, const IrradianceAround& irradiance) const;
  const SceneEvaluator& evaluatorOf(const std::vector<bool>& polygons) const;

  ReceiverGrid grid_;
  double pixel_size_;
  std::vector<double> distances_;
  ExactKnowledge exact_;
  std::optional<SampledKnowledge> sampled_;
  std::optional<TrueIrradiance> truth_;
  double reference_error_ = 0.0;
  double mean_irradiance_ = 0.0;
  std::vector<RecordKnowledge> records_;
  std::vector<ReprojectedError> reprojected_;  ///< with samples
  // Without: profiles that cost evaluations of a scene, when they have been asked for.
  std::unique_ptr<std::once_flag[]> once_;
  mutable std::vector<ErrorProfile> predicted_;
  mutable std::mutex mutex_;  ///< of the following
  mutable std::map<std::vector<bool>, SceneEvaluator> of_seen_polygons_;
};

}  // namespace irradiff
