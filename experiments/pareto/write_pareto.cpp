#include "experiments/pareto/pareto.h"
#include "experiments/pareto/pareto_page.h"
#include "experiments/pareto/trade_plot.h"
#include "experiments/pareto/trade_tables.h"

#include <nlohmann/json.hpp>

#include <chrono>

namespace irradiff {

namespace {

nlohmann::ordered_json configurationOf(const ParetoPlan& plan) {
  std::vector<std::string> families;
  for (const InputFamily& family : inputFamilies()) {
    const std::string name(family.name);
    if (plan.families.empty() || std::ranges::find(plan.families, name) != plan.families.end()) {
      families.push_back(name);
    }
  }
  return {{"effort", nameOf(plan.effort)}, {"families", families},         {"inputs", plan.inputs},
          {"rounds", plan.rounds},         {"rays", plan.estimators.rays}, {"receivers", plan.estimators.receivers}};
}

}  // namespace

ParetoPlan paretoPlan(Effort effort, std::uint64_t seed) {
  ParetoPlan plan;
  plan.effort = effort;
  plan.seed = plan.estimators.seed = seed;
  switch (effort) {
    case Effort::kQuick:
      plan.inputs = 16;
      plan.rounds = 3;
      plan.estimators = {{64, 256, 1024}, 24, 6, 3, seed};
      break;
    case Effort::kStandard:
      plan.inputs = 60;
      plan.rounds = 7;
      plan.estimators = {{64, 256, 1024, 4096}, 128, 16, 5, seed};
      break;
    case Effort::kFull:
      plan.inputs = 250;
      plan.rounds = 15;
      plan.estimators = {{64, 256, 1024, 4096, 16384}, 512, 32, 9, seed};
      break;
  }
  return plan;
}

Pareto measurePareto(const ParetoPlan& plan, const FigureScene& scene, const QualityProgress& progress) {
  Pareto pareto;
  pareto.plan = plan;
  std::vector<const InputFamily*> families;
  for (const std::string& name : plan.families) families.push_back(&inputFamily(name));
  if (families.empty()) {
    for (const InputFamily& family : inputFamilies()) families.push_back(&family);
  }
  std::size_t done = 0;
  for (const InputFamily* family : families) {
    if (progress) progress("speed against accuracy", done++, families.size() + 1);
    const FamilyInputs inputs = familyInputs(*family, plan.inputs, plan.seed);
    pareto.families.push_back(tradeOf(inputs, plan.rounds));
    for (RuleRegret& regret : regretsOf(inputs, plan.rounds)) pareto.regrets.push_back(std::move(regret));
  }
  if (progress) progress("speed against accuracy", done, families.size() + 1);
  pareto.estimators = estimatorTrades(scene, plan.estimators);
  return pareto;
}

void writePareto(const Pareto& pareto, const RunRecord& record, const ResultFolder& folder,
                 const std::filesystem::path& subfolder) {
  const std::string svg = tradePlot(pareto);
  folder.write(subfolder / "pareto.svg", svg);
  const auto writeTable = [&](const char* name, const ResultTable& table) {
    folder.write(subfolder / (std::string(name) + ".csv"), table.csv());
    folder.write(subfolder / (std::string(name) + ".json"), table.json());
  };
  writeTable("trade", tradeTable(pareto));
  writeTable("errors", errorTable(pareto));
  writeTable("estimators", estimatorTable(pareto));
  const ResultTable regret = regretTable(pareto);
  writeTable("regret", regret);
  folder.write(subfolder / "index.html", paretoPage(pareto, record, svg));
  folder.write(subfolder / "run.json", runJson(record, configurationOf(pareto.plan), pareto.plan.seed,
                                               {{"regret", nlohmann::ordered_json::parse(regret.json())}}));
}

}  // namespace irradiff
