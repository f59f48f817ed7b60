#include "experiments/cache_3d/room_field.h"

#include "derivatives/boundary/irradiance.h"
#include "experiments/cache_3d/camera_view.h"
#include "experiments/cache_3d/direct_light.h"
#include "experiments/cache_3d/gather_evaluation.h"
#include "experiments/cache_3d/image_irradiance.h"
#include "experiments/cache_3d/knowledge_numbers.h"
#include "experiments/cache_3d/known_geometry.h"
#include "experiments/cache_3d/metric_records.h"
#include "experiments/cache_3d/room_gather.h"
#include "experiments/cache_3d/room_reference.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {

namespace {

constexpr std::size_t kReprojectedNumbers = reprojectionNumbers(kRoomProfileDirections, kRoomPredictedDistances);
constexpr std::size_t kGatherNumbers = kKnowledgeNumbers + kReprojectedNumbers;
constexpr std::size_t kTruthNumbers = 4;

/// From half a pixel to the extent of the room, each the same multiple of the one before.
std::vector<double> profileDistances(double pixel_size, double extent, std::size_t count) {
  std::vector<double> distances;
  const double first = 0.5 * pixel_size;
  const double last = std::max(extent, 2.0 * pixel_size);
  for (std::size_t m = 0; m < count; ++m) {
    distances.push_back(first * std::pow(last / first, static_cast<double>(m) / static_cast<double>(count - 1)));
  }
  return distances;
}

/// What is seen in each row of the image.
struct Row {
  std::size_t number;
  std::size_t first;  ///< of the seen points
  std::size_t count;
};

std::vector<Row> rowsOf(std::span<const SeenPoint> seen, std::size_t width) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const std::size_t row = seen[i].pixel / width;
    if (rows.empty() || rows.back().number != row) rows.push_back({row, i, 0});
    ++rows.back().count;
  }
  return rows;
}

/// Rows of numbers from tiles, or else computed and stored as tiles.
class RowWork {
 public:
  RowWork(const TileStore* finished, std::span<const Row> rows) : finished_(finished), rows_(rows) {}

  /// Adds a task for each row: `numbersOf(i)` for its points, `take(i, numbers)` for each of them in the end.
  template <class NumbersOf, class Take>
  void add(std::size_t first_tile, std::size_t numbers_of_point, NumbersOf numbersOf, Take take) {
    for (const Row& row : rows_) {
      tasks_.emplace_back([this, row, first_tile, numbers_of_point, numbersOf, take] {
        const std::size_t tile = first_tile + row.number;
        std::optional<std::vector<double>> numbers;
        if (finished_ != nullptr) numbers = finished_->read(tile, row.count * numbers_of_point);
        if (!numbers) {
          numbers.emplace();
          for (std::size_t k = 0; k < row.count; ++k) numbersOf(row.first + k, *numbers);
          if (finished_ != nullptr) finished_->write(tile, *numbers);
        }
        for (std::size_t k = 0; k < row.count; ++k) take(row.first + k, numbers->data() + k * numbers_of_point);
      });
    }
  }

  void run(unsigned threads, const std::function<void(std::size_t, std::size_t)>& progress) const {
    runTasks(tasks_, threads, progress);
  }

 private:
  const TileStore* finished_;
  std::span<const Row> rows_;
  std::vector<std::function<void()>> tasks_;
};

/// What is known of the receivers when all rows are done.
struct RoomKnowledge {
  std::vector<RecordKnowledge> records;
  std::vector<ReprojectedError> predicted;  ///< of each receiver
  std::optional<ImageIrradiance> truth;
  double extent = 0.0;
  double mean_irradiance = 0.0;  ///< of all receivers

  /// What is not seen may differ by the mean radiance.
  ErrorProfile reprojection(std::size_t i) const {
    return predicted[i].profile(std::numbers::inv_pi * mean_irradiance);
  }

  RemainderAround predictedAround(std::size_t i) const {
    return [&error = predicted[i]](const Eigen::Vector2d& step) { return error.remainder(step); };
  }

  void addUnseen(std::size_t i, ErrorProfile& errors) const {
    predicted[i].addHidden(std::numbers::inv_pi * mean_irradiance, errors);
  }

  IrradianceAround truthAround(std::size_t i) const {
    const Receiver& receiver = truth->seen()[i].receiver;
    return [this, i, position = receiver.position, tangents = tangentFrame<double>(receiver.normal)](
               const Eigen::Vector2d& step) { return truth->at(i, position + tangents * step); };
  }

  std::vector<double> trueDistances(std::size_t i) const {
    return profileDistances(truth->seen()[i].pixel_size, extent, kRoomTrueDistances);
  }

  ErrorProfile oracle(std::size_t i) const {
    const SeenPoint& point = truth->seen()[i];
    const Eigen::Matrix<double, 3, 2> tangents = tangentFrame<double>(point.receiver.normal);
    return errorsOf({records[i].irradiance, tangents.transpose() * records[i].gradient}, truthAround(i),
                    trueDistances(i), kRoomProfileDirections);
  }
};

/// The distance from a seen point to the farthest vertex of the polygons in its plane. m
double reachOf(const Room& room, std::span<const std::size_t> planes, const SeenPoint& point) {
  double reach = 0.0;
  for (std::size_t k = 0; k < room.polygons.size(); ++k) {
    if (planes[k] != point.plane) continue;
    for (const Eigen::Vector3d& vertex : room.polygons[k].vertices) {
      reach = std::max(reach, (vertex - point.receiver.position).norm());
    }
  }
  return reach;
}

double meanOf(std::span<const SliceIrradiance> values) {
  double sum = 0.0;
  for (const SliceIrradiance& value : values) sum += value.irradiance;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

}  // namespace

RecordField roomField(const Room& room, const RoomFieldPlan& plan, const TileStore* finished,
                      const std::function<void(std::size_t, std::size_t)>& progress) {
  if (plan.width == 0) throw std::invalid_argument("the image of room " + room.name + " is 0 pixels wide, must be 1");
  const GridShape shape = gatherShape(plan.rays);
  const std::vector<SeenPoint> seen = seenPoints(room, plan.width);
  const std::vector<Row> rows = rowsOf(seen, plan.width);
  const SurfaceRadiance radiance = DirectLight(room).tabulated(plan.threads);

  auto known = std::make_shared<RoomKnowledge>();
  known->extent = extentOf(room);
  known->records.resize(seen.size());
  known->predicted.resize(seen.size());
  RowWork work(finished, rows);
  const RoomGather gather(room.polygons, radiance, shape, plan.seed);
  const KnownGeometry geometry(room.polygons, shape);
  const GatherEvaluation evaluation(shape, kRoomProfileDirections);
  work.add(
      0, kGatherNumbers,
      [&](std::size_t i, std::vector<double>& numbers) {
        const RoomSamples gathered = gather.gather(seen[i].receiver, seen[i].pixel);
        RecordKnowledge record = evaluation.knowledge(gathered.samples);
        record.known_geometry = geometry.firstOrder(seen[i].receiver, gathered);
        appendNumbers(record, numbers);
        appendNumbers(evaluation.reprojection(gathered.samples, profileDistances(seen[i].pixel_size, known->extent,
                                                                                 kRoomPredictedDistances)),
                      numbers);
      },
      [&known, &seen](std::size_t i, const double* numbers) {
        known->records[i] = knowledgeOf(std::span<const double, kKnowledgeNumbers>(numbers, kKnowledgeNumbers));
        known->predicted[i] =
            reprojectedErrorOf({numbers + kKnowledgeNumbers, kReprojectedNumbers}, kRoomProfileDirections,
                               profileDistances(seen[i].pixel_size, known->extent, kRoomPredictedDistances));
      });

  RoomReference reference;
  const SliceQuadrature quadrature(room.polygons, radiance);
  std::optional<RoomReference> kept;
  if (!plan.references.empty()) {
    kept = readReference(referencePath(plan.references, room, plan.width), room, plan.width, seen);
  }
  if (kept) {
    reference = *std::move(kept);
    work.run(plan.threads, progress);
  } else {
    reference.values.resize(seen.size());
    work.add(
        plan.width, kTruthNumbers,
        [&](std::size_t i, std::vector<double>& numbers) {
          const SliceIrradiance value = quadrature.at(seen[i].receiver);
          numbers.push_back(value.irradiance);
          numbers.insert(numbers.end(), value.gradient.begin(), value.gradient.end());
        },
        [&reference](std::size_t i, const double* numbers) {
          reference.values[i] = {numbers[0], {numbers[1], numbers[2], numbers[3]}};
        });
    work.run(plan.threads, progress);
    reference.rms_error = referenceError(room, radiance, seen, reference.values, kErrorPoints, plan.threads);
  }

  RecordField field;
  field.name = room.name;
  field.width = plan.width;
  field.height = plan.width;
  field.reference_error = reference.rms_error;
  field.rays_per_record = shape.size();
  field.offers_known_geometry = shape.size() >= kFewestRaysWithGeometry;
  field.metrics = recordMetrics(true);
  std::vector<Eigen::Vector3d> gradients;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    field.pixels.push_back(seen[i].pixel);
    field.receivers.push_back(seen[i].receiver);
    field.faces.push_back(seen[i].polygon);
    field.pixel_sizes.push_back(seen[i].pixel_size);
    field.reference.push_back(reference.values[i].irradiance);
    gradients.push_back(reference.values[i].gradient);
  }
  known->truth.emplace(room.camera, plan.width, seen, field.reference, std::move(gradients));

  auto knowledge = std::make_shared<FieldKnowledge>();
  knowledge->receivers = field.receivers;
  knowledge->pixel_sizes = field.pixel_sizes;
  knowledge->offers_known_geometry = field.offers_known_geometry;
  knowledge->record = [known](std::size_t i) { return known->records[i]; };
  knowledge->reprojection = [known](std::size_t i) { return known->reprojection(i); };
  knowledge->oracle = [known](std::size_t i) { return known->oracle(i); };
  knowledge->predicted = [known](std::size_t i) { return known->predictedAround(i); };
  knowledge->add_unseen = [known](std::size_t i, ErrorProfile& errors) { known->addUnseen(i, errors); };
  knowledge->truth = [known](std::size_t i) { return known->truthAround(i); };
  knowledge->profile_distances = [known](std::size_t i) { return known->predicted[i].distances; };
  knowledge->true_distances = [known](std::size_t i) { return known->trueDistances(i); };
  knowledge->profile_directions = kRoomProfileDirections;
  // Polygons that are not seen have no receivers to reach.
  std::vector<std::size_t> planes(room.polygons.size(), room.polygons.size());
  for (const SeenPoint& point : seen) planes[point.polygon] = point.plane;
  std::vector<double> reaches;
  for (const SeenPoint& point : seen) reaches.push_back(reachOf(room, planes, point));
  knowledge->reach = [reaches = std::move(reaches)](std::size_t i) { return reaches[i]; };
  known->mean_irradiance = meanOf(reference.values);
  knowledge->least_irradiance = kLeastIrradianceShare * known->mean_irradiance;
  field.records = [knowledge](const MetricChoice& choice) { return recordMaker(knowledge, choice); };
  field.true_error = trueError(knowledge);
  return field;
}

}  // namespace irradiff
