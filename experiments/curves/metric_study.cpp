#include "experiments/curves/metric_study.h"

#include "experiments/cache/placement.h"
#include "experiments/curves/paper_figures.h"
#include "experiments/curves/placement_pictures.h"
#include "experiments/curves/study_gains.h"
#include "verification/report/parallel_tasks.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace irradiff {

namespace {

constexpr const char* kBoxName = "cornell_box";
constexpr const char* kBlackWallName = "cornell_box_black_back_wall";
constexpr const char* kPenumbraName = "indirect_penumbra";
/// Figure 10: 256 rays beside 4096.
constexpr std::size_t kFewerRays = 16;

std::size_t largestUpTo(const std::vector<std::size_t>& counts, std::size_t most) {
  std::size_t largest = counts.front();
  for (const std::size_t count : counts) largest = count <= most ? count : largest;
  return largest;
}

/// What the studies of all scenes share.
struct Workshop {
  const StudyPlan& plan;
  unsigned threads;
  const MakeStore& make_store;
  const StudyProgress& progress;

  std::function<void(std::size_t, std::size_t)> telling(const std::string& work) const {
    return [this, work](std::size_t done, std::size_t all) {
      if (progress) progress(work, done, all);
    };
  }

  std::unique_ptr<TileStore> store(const std::string& name, const std::string& fingerprint) const {
    return make_store ? make_store(name, fingerprint) : nullptr;
  }

  RecordFieldPlan fieldPlan(const RecordScene& scene, std::uint64_t seed) const {
    if (scene.isFlatland()) return {plan.flatland_receivers, 0, seed, threads};
    if (scene.isPlane()) return {plan.plane_width, 0, seed, threads};
    return {plan.room_width, plan.room_rays, seed, threads};
  }

  RecordField field(const RecordScene& scene, const RecordFieldPlan& field_plan) const {
    const std::string name =
        scene.name + "-rays" + std::to_string(field_plan.rays) + "-seed" + std::to_string(field_plan.seed);
    const std::unique_ptr<TileStore> finished = store(name, fieldFingerprint(scene, field_plan));
    return recordField(scene, field_plan, finished.get(), telling("records of " + scene.name));
  }

  /// Nothing random, one seed.
  std::vector<RecordField> fields(const RecordScene& scene) const {
    const bool is_sampled = fieldPlan(scene, plan.seed).rays > 0;
    std::vector<RecordField> all;
    for (std::size_t i = 0; i < (is_sampled ? plan.seeds : 1); ++i) {
      all.push_back(field(scene, fieldPlan(scene, plan.seed + i)));
    }
    return all;
  }
};

std::string curvesFingerprint(const RecordScene& scene, const Workshop& shop, const std::vector<std::string>& metrics,
                              const std::vector<std::size_t>& counts) {
  const nlohmann::ordered_json all = {{"field", fieldFingerprint(scene, shop.fieldPlan(scene, shop.plan.seed))},
                                      {"seeds", shop.plan.seeds},
                                      {"metrics", metrics},
                                      {"records", counts}};
  return all.dump();
}

std::vector<MetricPictures> picturesOf(const RecordField& field, const SceneStudy& study, unsigned threads) {
  std::vector<CacheVariant> variants;
  for (const CurvePoint& point : study.curves.points) {
    if (point.field != 0 || point.asked_records != study.table_records || !point.is_within) continue;
    CacheVariant variant{point.metric, &field, defaultChoice(field, point.metric), {}, std::nullopt};
    variant.choice.threshold = point.threshold;
    variants.push_back(std::move(variant));
  }
  std::vector<MetricPictures> pictures;
  for (VariantResult& result : runVariants(variants, threads)) {
    pictures.push_back({result.metric, result.records, result.error.rms, std::move(result.footprints),
                        std::move(result.radii), std::move(result.errors)});
  }
  return pictures;
}

double gatherError(const RecordField& field, const MetricChoice& choice) {
  const RecordMaker records = field.records(choice);
  std::vector<double> gathered(field.receivers.size());
  for (std::size_t i = 0; i < gathered.size(); ++i) gathered[i] = records(i).irradiance;
  return imageError(gathered, field.reference).rms;
}

void describeField(SceneStudy& study, const RecordField& field) {
  double mean = 0.0;
  for (const double value : field.reference) mean += value / static_cast<double>(field.reference.size());
  study.width = field.width;
  study.height = field.height;
  study.receivers = field.receivers.size();
  study.rays_per_record = field.rays_per_record;
  study.reference_error = field.reference_error / mean;
  MetricChoice choice = defaultChoice(field, field.metrics.front());
  study.gather_error = gatherError(field, choice);
  choice.knows_geometry = true;
  if (field.offers_known_geometry) study.known_gather_error = gatherError(field, choice);
  study.reference = amountPicture(field, field.reference, "reference", "irradiance, the reference", "W/m^2",
                                  amountLimit(field.reference));
}

/// Those of `asked` that the field has; all if nothing is asked for.
std::vector<std::string> metricsOn(const RecordField& field, const std::vector<std::string>& asked) {
  if (asked.empty()) return field.metrics;
  std::vector<std::string> metrics;
  for (const std::string& metric : field.metrics) {
    if (std::ranges::find(asked, metric) != asked.end()) metrics.push_back(metric);
  }
  if (metrics.empty()) throw std::runtime_error(field.name + ": has none of the metrics that are asked for");
  return metrics;
}

/// From the best of the published metrics to ours in steps that each change one thing, and the oracle. Without points
/// where the field or what is asked for lacks one of them.
std::vector<std::string> namesOf(std::span<const NamedChoice> choices) {
  std::vector<std::string> names;
  for (const NamedChoice& choice : choices) names.push_back(choice.name);
  return names;
}

ErrorCurves ablationOf(const RecordScene& scene, const std::vector<RecordField>& fields, const SceneStudy& study,
                       const Workshop& shop) {
  constexpr const char* kOcclusion = "occlusion-hessian";
  constexpr const char* kSecondOrder = "second-order";
  const std::vector<std::string> metrics = study.curves.metrics();
  const auto has = [&metrics](const std::string& metric) {
    return std::ranges::find(metrics, metric) != metrics.end();
  };
  if (!fields.front().offers_known_geometry || !has(kOcclusion) || !has(kSecondOrder)) return {};
  const auto variant = [](const char* metric, bool knows_geometry, const std::string& name) {
    return NamedChoice{name, [metric, knows_geometry](const RecordField& field) {
                         MetricChoice choice = defaultChoice(field, metric);
                         choice.knows_geometry = knows_geometry;
                         return choice;
                       }};
  };
  std::vector<NamedChoice> variants{
      variant(kOcclusion, true, "occlusion-hessian, known geometry"),
      variant(kSecondOrder, false, "second-order, from samples alone"),
  };
  if (has("oracle")) variants.push_back(variant("oracle", true, "oracle's regions, known geometry"));
  std::vector<std::size_t> counts;
  for (const std::size_t count : possibleCounts(fields.front(), shop.plan.records)) {
    if (std::ranges::find(kGoalRecords, count) != kGoalRecords.end()) counts.push_back(count);
  }
  if (counts.empty()) return {};
  const std::unique_ptr<TileStore> finished =
      shop.store(scene.name + "-ablation", curvesFingerprint(scene, shop, namesOf(variants), counts));
  const ErrorCurves made = choiceCurves(fields, variants, counts, {}, shop.threads, finished.get(),
                                        shop.telling("ablation of " + scene.name));
  ErrorCurves ablation;
  ablation.scene = study.curves.scene;
  const auto add = [&](const ErrorCurves& from, const std::string& metric, const std::string& name) {
    for (CurvePoint point : from.points) {
      if (point.metric != metric || std::ranges::find(counts, point.asked_records) == counts.end()) continue;
      point.metric = name;
      ablation.points.push_back(std::move(point));
    }
  };
  add(study.curves, kOcclusion, kOcclusion);
  add(made, variants[0].name, variants[0].name);
  add(study.curves, "reprojection", "reprojection");
  add(made, variants[1].name, variants[1].name);
  add(study.curves, kSecondOrder, "second-order, known geometry");
  add(study.curves, "oracle", "oracle");
  if (has("oracle")) add(made, variants.back().name, variants.back().name);
  return ablation;
}

SceneStudy studyOf(const RecordScene& scene, const std::vector<RecordField>& fields, const Workshop& shop) {
  const RecordField& first = fields.front();
  SceneStudy study;
  study.name = scene.name;
  study.description = scene.description;
  study.is_flatland = scene.isFlatland();
  describeField(study, first);
  const std::vector<std::string> metrics = metricsOn(first, shop.plan.metrics);
  const std::vector<std::size_t> counts = possibleCounts(first, shop.plan.records);
  {
    const std::unique_ptr<TileStore> finished =
        shop.store(scene.name + "-curves", curvesFingerprint(scene, shop, metrics, counts));
    study.curves =
        errorCurves(fields, metrics, counts, {}, shop.threads, finished.get(), shop.telling("curves of " + scene.name));
  }
  study.ablation = ablationOf(scene, fields, study, shop);
  study.table_records = largestUpTo(counts, kPublishedRecords);
  study.order = publishedOrder(study.curves, study.table_records);
  study.ratio_records = largestUpTo(counts, shop.plan.ratio_records);
  study.ratios =
      regionRatios(first, study.curves, study.ratio_records, shop.threads, shop.telling("regions of " + scene.name));
  study.pictures = picturesOf(first, study, shop.threads);
  for (const RegionRatios& ratios : study.ratios) {
    study.ratio_pictures.push_back(
        {ratios.metric, ratioPicture(first, ratios.radii, "radius-ratio", "radius over the oracle's"),
         ratioPicture(first, ratios.errors, "error-ratio", "true error over what the oracle's threshold allows")});
  }
  return study;
}

/// A room beside another, such as the Cornell box with a black wall.
std::optional<RecordScene> roomFile(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(IRRADIFF_ROOM_FOLDER) / (name + ".json");
  if (!std::filesystem::exists(path)) return std::nullopt;
  return readRecordScene(path);
}

std::vector<CacheComparison> comparisonsOf(const RecordScene& box, const RecordField& field, std::size_t records,
                                           const Workshop& shop) {
  PaperFields fields;
  fields.box = &field;
  std::vector<std::unique_ptr<RecordField>> others;
  const auto add = [&](const RecordScene& scene, std::size_t rays) {
    RecordFieldPlan plan = shop.fieldPlan(scene, shop.plan.seed);
    plan.rays = rays;
    others.push_back(std::make_unique<RecordField>(shop.field(scene, plan)));
    return others.back().get();
  };
  fields.few_rays = add(box, shop.plan.room_rays / kFewerRays);
  if (const auto black = roomFile(kBlackWallName)) fields.black_wall = add(*black, shop.plan.room_rays);
  if (const auto penumbra = roomFile(kPenumbraName)) fields.penumbra = add(*penumbra, shop.plan.room_rays);
  return paperFigures(fields, records, shop.threads, shop.telling("the paper's figures"));
}

}  // namespace

StudyPlan studyPlan(Effort effort, std::uint64_t seed) {
  StudyPlan plan;
  plan.effort = effort;
  plan.seed = seed;
  plan.records = {100, 200, 300, 500, 1000, kPublishedRecords, 3000, 5000, 8000};
  switch (effort) {
    case Effort::kQuick:
      plan.room_width = plan.plane_width = 96;
      plan.room_rays = 1024;
      plan.flatland_receivers = 4096;
      plan.records = {100, 300, 1000, kPublishedRecords};
      break;
    case Effort::kStandard:
      break;
    case Effort::kFull:
      plan.seeds = 3;
      break;
  }
  return plan;
}

StudyPlan leastStudyPlan(std::uint64_t seed) {
  StudyPlan plan = studyPlan(Effort::kQuick, seed);
  plan.room_width = plan.plane_width = 40;
  plan.room_rays = 256;
  plan.flatland_receivers = 1024;
  plan.records = {50, 100, 200};
  plan.ratio_records = 200;
  return plan;
}

std::vector<std::filesystem::path> studyScenes() {
  const std::filesystem::path rooms = IRRADIFF_ROOM_FOLDER;
  return {rooms / "flatland_lamp.json", std::filesystem::path(IRRADIFF_SCENE_FOLDER) / "figure5.json",
          rooms / (std::string(kBoxName) + ".json")};
}

MetricStudy metricStudy(const StudyPlan& plan, const std::vector<RecordScene>& scenes, unsigned threads,
                        const MakeStore& make_store, const StudyProgress& progress) {
  const Workshop shop{plan, threads, make_store, progress};
  MetricStudy study;
  study.plan = plan;
  for (const RecordScene& scene : scenes) {
    const std::vector<RecordField> fields = shop.fields(scene);
    study.scenes.push_back(studyOf(scene, fields, shop));
    const bool is_box = scene.name == kBoxName && std::holds_alternative<Room>(scene.scene);
    if (is_box && plan.has_comparisons) {
      study.comparisons = comparisonsOf(scene, fields.front(), study.scenes.back().table_records, shop);
    }
  }
  return study;
}

}  // namespace irradiff
