#include "experiments/cache_3d/plane_field.h"

#include "experiments/cache_3d/metric_records.h"
#include "experiments/cache_3d/plane_knowledge.h"

#include <memory>
#include <stdexcept>

namespace irradiff {
namespace {

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
  const auto plane = std::make_shared<PlaneKnowledge>(scene, plan);
  plane->gather(plan.threads, finished, progress);

  RecordField field;
  field.name = scene.name;
  const ReceiverGrid& grid = plane->grid();
  field.width = grid.width;
  field.height = grid.height;
  field.reference_error = plane->referenceError();
  field.rays_per_record = plane->rays();
  field.metrics = recordMetrics(true);
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
  if (!(plane->meanIrradiance() > 0.0)) {
    throw std::invalid_argument(scene.name + ": no receiver of the grid has any light, some must");
  }
  knowledge->receivers = field.receivers;
  knowledge->pixel_sizes = field.pixel_sizes;
  knowledge->least_irradiance = kLeastIrradianceShare * plane->meanIrradiance();
  knowledge->record = [plane, inGrid](std::size_t pixel) { return plane->record(inGrid(pixel)); };
  knowledge->reprojection = [plane, inGrid](std::size_t pixel) { return plane->reprojection(inGrid(pixel)); };
  knowledge->oracle = [plane, inGrid](std::size_t pixel) { return plane->oracle(inGrid(pixel)); };
  knowledge->truth = [plane, inGrid](std::size_t pixel) { return plane->truthAround(inGrid(pixel)); };
  knowledge->predicted = [plane, inGrid](std::size_t pixel) { return plane->remainderAround(inGrid(pixel)); };
  knowledge->add_unseen = [plane, inGrid](std::size_t pixel, ErrorProfile& errors) {
    plane->addUnseen(inGrid(pixel), errors);
  };
  knowledge->profile_distances = [plane](std::size_t) { return plane->distances(); };
  knowledge->true_distances = knowledge->profile_distances;
  knowledge->profile_directions = kPlaneProfileDirections;
  field.records = [knowledge](const MetricChoice& choice) { return recordMaker(knowledge, choice); };
  field.true_error = trueError(knowledge);
  return field;
}

}  // namespace irradiff
