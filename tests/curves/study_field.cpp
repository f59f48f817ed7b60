#include "tests/curves/study_field.h"

#include "experiments/cache/irradiance_cache.h"
#include "tests/cache/synthetic_field.h"

#include <cmath>
#include <numbers>

namespace irradiff::curves_test {

namespace {

constexpr std::size_t kAngles = 24;
constexpr std::size_t kRings = 12;

/// Eq. (4) by the midpoint rule.
double trueError(const CacheRecord& record) {
  double sum = 0.0;
  for (std::size_t k = 0; k < kAngles; ++k) {
    const double angle = 2.0 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(kAngles);
    for (std::size_t m = 0; m < kRings; ++m) {
      const double radius = (static_cast<double>(m) + 0.5) / static_cast<double>(kRings);
      Receiver receiver = record.receiver;
      receiver.position += radius * (std::cos(angle) * record.half_axes.x() * record.first_axis +
                                     std::sin(angle) * record.half_axes.y() * record.second_axis);
      const double truth = cache_test::bumpyIrradiance(cache_test::fourBumps(), receiver.position.head<2>()).irradiance;
      sum += std::abs(truth - extrapolated(record, receiver)) * radius;
    }
  }
  const double cell = 2.0 * std::numbers::pi / static_cast<double>(kAngles) / static_cast<double>(kRings);
  return sum * cell * record.half_axes.prod();
}

}  // namespace

RecordField studyField(std::size_t width) {
  RecordField field = cache_test::bumpyField(width);
  const auto inner = field.records;
  field.name = "bumps";
  field.metrics = {"bounded-split-sphere", "occlusion-hessian", "oracle"};
  field.rays_per_record = 100;
  field.records = [inner](const MetricChoice& choice) -> RecordMaker {
    MetricChoice named = choice;
    named.metric = choice.metric.ends_with("split-sphere") ? "circle" : "hessian";
    const RecordMaker maker = inner(named);
    const double factor = choice.metric == "oracle" ? 2.0 : 1.0;
    return [maker, factor](std::size_t receiver) {
      CacheRecord record = maker(receiver);
      record.half_axes *= factor;
      return record;
    };
  };
  field.true_error = [](std::size_t /*receiver*/, const CacheRecord& record) { return trueError(record); };
  return field;
}

RecordField publishedField(std::size_t width) {
  RecordField field = studyField(width);
  field.metrics = {"split-sphere",
                   "bounded-split-sphere",
                   "radiometric-hessian",
                   "geometric-hessian",
                   "occlusion-hessian",
                   "reprojection",
                   "oracle"};
  return field;
}

ErrorCurves powerCurves(const std::vector<PowerLaw>& laws, const std::vector<std::size_t>& counts, std::size_t fields,
                        double spread) {
  ErrorCurves curves;
  curves.scene = "powers";
  for (const PowerLaw& law : laws) {
    for (std::size_t field = 0; field < fields; ++field) {
      for (const std::size_t count : counts) {
        const double rms =
            law.factor * std::pow(static_cast<double>(count), law.power) * (1.0 + spread * static_cast<double>(field));
        curves.points.push_back({law.metric, field, count, count, 100 * count, 1.0, true, {rms, 3.0 * rms, 9.0 * rms}});
      }
    }
  }
  return curves;
}

ErrorCurves publishedCurves() {
  std::vector<PowerLaw> laws;
  const auto add = [&laws](const char* metric, double rms) {
    laws.push_back({metric, rms * std::pow(1700.0, 0.75), -0.75});
  };
  add("split-sphere", 0.0901);
  add("bounded-split-sphere", 0.0290);
  add("radiometric-hessian", 0.0912);
  add("geometric-hessian", 0.0105);
  add("occlusion-hessian", 0.0071);
  add("reprojection", 0.00213);
  add("oracle", 0.00142);
  return powerCurves(laws, {300, 1000, 1700, 3000});
}

SceneStudy sceneOf(const ErrorCurves& curves) {
  SceneStudy scene;
  scene.name = "cornell_box";
  scene.description = "A box.";
  scene.width = scene.height = 8;
  scene.receivers = 64;
  scene.rays_per_record = 100;
  scene.curves = curves;
  scene.table_records = 1700;
  scene.order = publishedOrder(curves, 1700);
  scene.ratio_records = 1000;
  return scene;
}

}  // namespace irradiff::curves_test
