#include "experiments/cache_2d/flatland_field.h"

#include "derivatives/scene/invalid_scene.h"
#include "experiments/cache_2d/flatland_records.h"
#include "experiments/cache_2d/wall_receivers.h"
#include "experiments/io/scene_file.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace irradiff {
namespace {

constexpr std::size_t kReceiversPerTask = 32;
/// Of the quadrature, as a share of the brightest irradiance; checked in tests/cache_2d.
constexpr double kReferenceError = 1e-10;

}  // namespace

FlatlandLight flatlandLightOf(std::string_view name) {
  if (name == "indirect") return FlatlandLight::kIndirect;
  if (name == "total") return FlatlandLight::kTotal;
  throw std::invalid_argument("unknown light \"" + std::string(name) + "\": must be one of indirect, total");
}

RecordField flatlandField(const FlatlandRoom& room, const FlatlandFieldPlan& plan,
                          const std::function<void(std::size_t, std::size_t)>& progress) {
  if (plan.receivers == 0 || plan.receivers > kMaxReceivers) {
    throw std::invalid_argument("room " + room.name + ": " + std::to_string(plan.receivers) +
                                " receivers asked for, must be 1 to " + std::to_string(kMaxReceivers));
  }
  const LitRoom lit(room, plan.light == FlatlandLight::kTotal);
  auto walls = std::make_shared<WallReceivers>(lit, plan.receivers);
  if (walls->receivers.empty()) {
    throw InvalidScene("room " + room.name + ": no light arrives on a wall that reflects, must on one");
  }
  const std::size_t count = walls->receivers.size();
  auto records = std::make_shared<FlatlandRecords>(walls);
  std::vector<std::function<void()>> tasks;
  for (std::size_t begin = 0; begin < count; begin += kReceiversPerTask) {
    tasks.push_back([&, begin] {
      for (std::size_t i = begin; i < std::min(count, begin + kReceiversPerTask); ++i) records->gatherAt(lit, i);
    });
  }
  runTasks(tasks, plan.threads, progress);

  RecordField field;
  field.name = room.name;
  field.width = walls->cells;
  field.height = 1;
  double brightest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const WallReceiver& receiver = walls->receivers[i];
    field.pixels.push_back(receiver.cell);
    field.receivers.push_back(records->receiver(i));
    field.faces.push_back(receiver.side);
    field.pixel_sizes.push_back(receiver.cell_length);
    field.reference.push_back(records->gatherOf(i).irradiance);
    brightest = std::max(brightest, field.reference.back());
  }
  field.reference_error = kReferenceError * brightest;
  field.metrics = FlatlandRecords::metrics();
  field.records = [records](const MetricChoice& choice) { return FlatlandRecords::maker(records, choice); };
  field.true_error = [records](std::size_t receiver, const CacheRecord& record) {
    return records->trueError(receiver, record.half_axes(0));
  };
  return field;
}

}  // namespace irradiff
