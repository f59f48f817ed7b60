#include "experiments/curves/curve_plots.h"
#include "experiments/curves/metric_study.h"
#include "experiments/curves/study_page.h"
#include "experiments/curves/study_tables.h"
#include "experiments/curves/study_text.h"
#include "experiments/figures/picture_preview.h"
#include "experiments/io/png_file.h"

#include <nlohmann/json.hpp>

#include <cctype>

namespace irradiff {

namespace {

nlohmann::ordered_json configurationOf(const MetricStudy& study) {
  const StudyPlan& plan = study.plan;
  std::vector<std::string> scenes;
  for (const SceneStudy& scene : study.scenes) scenes.push_back(scene.name);
  return {{"effort", nameOf(plan.effort)},
          {"scenes", scenes},
          {"seeds", plan.seeds},
          {"room_width", plan.room_width},
          {"room_rays", plan.room_rays},
          {"plane_width", plan.plane_width},
          {"flatland_receivers", plan.flatland_receivers},
          {"records", plan.records},
          {"ratio_records", plan.ratio_records}};
}

/// A label as the name of a file: letters and digits, all else a dash.
std::string fileName(const std::string& label) {
  std::string name;
  for (const char c : label) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  while (name.ends_with('-')) name.pop_back();
  return name;
}

void writePictures(const MetricStudy& study, const ResultFolder& folder, const std::filesystem::path& subfolder) {
  const auto write = [&](const std::filesystem::path& place, const std::string& name, const MapPicture& picture) {
    folder.write(subfolder / place / (name + ".png"), pngFile(preview(picture)));
  };
  for (const SceneStudy& scene : study.scenes) {
    write(scene.name, "reference", scene.reference);
    for (const MetricPictures& shown : scene.pictures) {
      write(scene.name, shown.metric + ".footprints", shown.footprints);
      write(scene.name, shown.metric + ".radii", shown.radii);
      write(scene.name, shown.metric + ".error", shown.errors);
    }
    for (const RatioPictures& shown : scene.ratio_pictures) {
      write(scene.name, shown.metric + ".radius-ratio", shown.radii);
      write(scene.name, shown.metric + ".error-ratio", shown.errors);
    }
  }
  for (const CacheComparison& comparison : study.comparisons) {
    for (const VariantResult& result : comparison.results) {
      const std::string name = fileName(result.label);
      write(comparison.id, name + ".footprints", result.footprints);
      write(comparison.id, name + ".radii", result.radii);
      write(comparison.id, name + ".error", result.errors);
    }
  }
}

}  // namespace

void writeStudy(const MetricStudy& study, const RunRecord& record, const ResultFolder& folder,
                const std::filesystem::path& subfolder) {
  const auto writeTable = [&](const char* name, const ResultTable& table) {
    folder.write(subfolder / (std::string(name) + ".csv"), table.csv());
    folder.write(subfolder / (std::string(name) + ".json"), table.json());
  };
  writeTable("curves", curveTable(study));
  writeTable("ablation", ablationTable(study));
  writeTable("slopes", slopeTable(study));
  writeTable("ratios", ratioTable(study));
  const ResultTable order = orderTable(study);
  writeTable("table", order);
  writeTable("figures", comparisonTable(study));
  std::vector<ScenePlots> plots;
  for (const SceneStudy& scene : study.scenes) {
    ScenePlots& made = plots.emplace_back();
    made.curves = curvePlot(scene);
    folder.write(subfolder / (scene.name + "_curves.svg"), made.curves);
    if (scene.ratios.empty()) continue;
    made.ratios = ratioPlot(scene);
    folder.write(subfolder / (scene.name + "_ratios.svg"), made.ratios);
  }
  writePictures(study, folder, subfolder);
  folder.write(subfolder / "metrics.md", studyMarkdown(study, record));
  folder.write(subfolder / "index.html", studyPage(study, record, plots));
  folder.write(subfolder / "run.json", runJson(record, configurationOf(study), study.plan.seed,
                                               {{"conclusions", conclusionSentences(study)},
                                                {"table", nlohmann::ordered_json::parse(order.json())}}));
}

}  // namespace irradiff
