#include "experiments/atlas/atlas.h"

#include "experiments/atlas/atlas_page.h"
#include "experiments/atlas/atlas_pictures.h"
#include "experiments/atlas/atlas_text.h"
#include "experiments/atlas/event_map.h"
#include "experiments/atlas/region_file.h"
#include "experiments/figures/program_fingerprint.h"
#include "experiments/io/exr_file.h"
#include "experiments/io/png_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiff {
namespace {

/// In EXR files, which hold no infinity: results that were not finite, and what is beyond all use.
constexpr double kFailedValue = 1e38;
constexpr double kLargestValue = 1e30;

nlohmann::ordered_json configurationOf(const AtlasPlan& plan) {
  return {{"cells", plan.cells},
          {"samples", plan.samples},
          {"event_cells", plan.event_cells},
          {"event_samples", plan.event_samples},
          {"rounds", plan.rounds},
          {"round_inputs", plan.round_inputs},
          {"event_round_inputs", plan.event_round_inputs}};
}

/// "boundary_closed_form.float.gradient".
std::string channelName(const VariantErrors& variant, std::size_t quantity) {
  std::string name = variant.formula + '.' + nameOf(variant.scalar) + '.' + kAtlasQuantityNames[quantity];
  std::erase(name, ',');
  std::ranges::replace(name, ' ', '_');
  return name;
}

ExrImage exrImage(const StabilityMap& map, const AtlasPlan& plan) {
  ExrImage image;
  image.width = image.height = map.cells;
  for (const VariantErrors& variant : map.variants) {
    for (std::size_t quantity = 0; quantity < kAtlasQuantities; ++quantity) {
      ExrImage::Channel channel{channelName(variant, quantity), {}};
      for (std::size_t row = map.cells; row-- > 0;) {
        for (std::size_t column = 0; column < map.cells; ++column) {
          const double error = variant.peak[quantity][row * map.cells + column];
          channel.values.push_back(std::isinf(error)   ? kFailedValue
                                   : std::isnan(error) ? error
                                                       : std::min(error, kLargestValue));
        }
      }
      image.channels.push_back(std::move(channel));
    }
  }
  nlohmann::ordered_json axes;
  for (const AtlasAxis* axis : {&map.x, &map.y}) {
    axes.push_back({{"name", axis->name}, {"low", axis->low}, {"high", axis->high}});
  }
  nlohmann::ordered_json configuration = configurationOf(plan);
  configuration["seed"] = plan.seed;
  image.attributes = {{"axes", axes.dump()}, {"configuration", configuration.dump()}};
  return image;
}

}  // namespace

AtlasPlan atlasPlan(Effort effort, std::uint64_t seed) {
  AtlasPlan plan;
  plan.seed = seed;
  if (effort == Effort::kStandard) {
    plan.cells = 48;
    plan.samples = 6;
    plan.event_cells = 24;
    plan.event_samples = 3;
    plan.rounds = 8;
    plan.round_inputs = 8000;
    plan.event_round_inputs = 400;
  } else if (effort == Effort::kFull) {
    plan.cells = 96;
    plan.samples = 12;
    plan.event_cells = 48;
    plan.event_samples = 4;
    plan.rounds = 16;
    plan.round_inputs = 20000;
    plan.event_round_inputs = 2000;
  }
  return plan;
}

AtlasPlan leastAtlasPlan(std::uint64_t seed) {
  AtlasPlan plan;
  plan.cells = 16;
  plan.samples = 1;
  plan.event_cells = 8;
  plan.event_samples = 1;
  plan.rounds = 8;
  plan.round_inputs = 80;
  plan.event_round_inputs = 10;
  plan.seed = seed;
  return plan;
}

std::string atlasFingerprint(const AtlasPlan& plan) {
  nlohmann::ordered_json all = configurationOf(plan);
  all["seed"] = plan.seed;
  all["program"] = programFingerprint();
  return all.dump();
}

Atlas makeAtlas(const AtlasPlan& plan, unsigned threads, const TileStore* finished, const QualityProgress& progress) {
  Atlas atlas{plan, polygonStability(plan, threads, finished, progress), {}, 0};
  atlas.maps.push_back(eventStability(plan, threads, finished, progress));
  for (;;) {
    atlas.statements = safetyStatements(atlas.maps, threads, progress);
    ++atlas.rounds;
    const std::string stream = "atlas round " + std::to_string(atlas.rounds);
    const std::vector<RegionProbe> probes =
        probeRegions(atlas.maps, atlas.statements, {stream, plan.seed, plan.round_inputs, plan.event_round_inputs},
                     threads, progress);
    countViolations(atlas.maps, probes, atlas.statements);
    if (countsOf(atlas).refuted == 0 || atlas.rounds >= plan.rounds) return atlas;
    raisePeaks(probes, atlas.maps);
  }
}

StatementCounts countsOf(const Atlas& atlas) {
  StatementCounts counts;
  for (const SafetyStatement& statement : atlas.statements) {
    counts.regions += statement.region ? 1 : 0;
    counts.refuted += statement.violations > 0 ? 1 : 0;
    counts.checks += statement.checked;
  }
  return counts;
}

void writeAtlas(const Atlas& atlas, const RunRecord& record, const ResultFolder& folder,
                const std::filesystem::path& subfolder) {
  std::vector<std::array<RgbImage, kAtlasQuantities>> sheets;
  for (const StabilityMap& map : atlas.maps) {
    folder.write(subfolder / (map.file + ".exr"), exrFile(exrImage(map, atlas.plan)));
    std::array<RgbImage, kAtlasQuantities> sheet;
    for (std::size_t quantity = 0; quantity < kAtlasQuantities; ++quantity) {
      sheet[quantity] = atlasSheet(map, atlas.statements, quantity);
      folder.write(subfolder / pictureFile(map, quantity), pngFile(sheet[quantity]));
    }
    sheets.push_back(std::move(sheet));
  }
  folder.write(subfolder / "regions.csv", regionTable(atlas).csv());
  folder.write(subfolder / "regions.json", regionsJson(atlas.statements));
  folder.write(subfolder / "atlas.md", atlasMarkdown(atlas, record));
  folder.write(subfolder / "index.html", atlasPage(atlas, record, sheets));
  nlohmann::ordered_json configuration = configurationOf(atlas.plan);
  configuration["threads"] = record.threads;
  const StatementCounts counts = countsOf(atlas);
  folder.write(subfolder / "run.json", runJson(record, configuration, atlas.plan.seed,
                                               {{"rounds", atlas.rounds},
                                                {"statements", atlas.statements.size()},
                                                {"regions", counts.regions},
                                                {"checks", counts.checks},
                                                {"refuted", counts.refuted}}));
}

}  // namespace irradiff
