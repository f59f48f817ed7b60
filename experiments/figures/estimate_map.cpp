#include "experiments/figures/estimate_map.h"

#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <optional>

namespace irradiff {

std::vector<double> EstimateMap::channel(EstimateValue value) const {
  std::vector<double> channel;
  channel.reserve(values.size());
  for (const EstimateValues& at : values) channel.push_back(at[value]);
  return channel;
}

SampleFrame sampleFrame(const ReceiverGrid& grid, std::size_t i, std::size_t j) {
  return {grid.receiver(i, j).position, grid.u.normalized(), grid.v.normalized(), grid.normal};
}

std::vector<EstimateMap> estimateMaps(std::span<const Polygon> polygons, const ReceiverGrid& grid,
                                      const SamplingPlan& plan, std::span<const std::string> estimators,
                                      unsigned threads, const TileStore* finished, std::size_t first_tile,
                                      const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<EstimateMap> maps;
  std::vector<PointEstimator> estimate;
  maps.reserve(estimators.size());
  estimate.reserve(estimators.size());
  for (const std::string& name : estimators) {
    maps.push_back({name, std::vector<EstimateValues>(grid.width * grid.height)});
    estimate.push_back(pointEstimator(name, plan.stratification, plan.shape));
  }
  const RayCaster caster(polygons);
  const std::size_t numbers_of_receiver = maps.size() * kEstimateValueCount;
  std::vector<std::function<void()>> rows;
  for (std::size_t j = 0; j < grid.height; ++j) {
    rows.emplace_back([&, j] {
      std::optional<std::vector<double>> tile;
      if (finished != nullptr) tile = finished->read(first_tile + j, grid.width * numbers_of_receiver);
      if (!tile) {
        tile.emplace();
        tile->reserve(grid.width * numbers_of_receiver);
        for (std::size_t i = 0; i < grid.width; ++i) {
          const SampleFrame frame = sampleFrame(grid, i, j);
          const ReceiverRays rays = caster.from(frame);
          const PointSamples samples = gatherSamples(rays, frame, plan, j * grid.width + i);
          for (const PointEstimator& estimator : estimate) {
            const EstimateValues values = valuesOf(estimator(samples));
            tile->insert(tile->end(), values.begin(), values.end());
          }
        }
        if (finished != nullptr) finished->write(first_tile + j, *tile);
      }
      auto from = tile->begin();
      for (std::size_t i = 0; i < grid.width; ++i) {
        for (EstimateMap& map : maps) {
          std::copy_n(from, kEstimateValueCount, map.values[j * grid.width + i].begin());
          from += kEstimateValueCount;
        }
      }
    });
  }
  runTasks(rows, threads, progress);
  return maps;
}

}  // namespace irradiff
