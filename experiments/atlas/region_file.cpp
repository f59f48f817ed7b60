#include "experiments/atlas/region_file.h"

#include "experiments/atlas/atlas.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace irradiff {
namespace {

using Json = nlohmann::ordered_json;

Json regionJson(const SafeRegion& region) {
  Json inequalities = Json::array();
  for (const SizeInequality& i : region.inequalities) {
    inequalities.push_back(
        {{"x_power", i.x_power}, {"y_power", i.y_power}, {i.is_at_least ? "at_least" : "at_most", i.bound}});
  }
  return inequalities;
}

SafeRegion regionOf(const Json& inequalities) {
  SafeRegion region;
  for (const Json& i : inequalities) {
    const bool is_at_least = i.contains("at_least");
    region.inequalities.push_back({i.at("x_power").get<int>(), i.at("y_power").get<int>(), is_at_least,
                                   i.at(is_at_least ? "at_least" : "at_most").get<double>()});
  }
  return region;
}

std::size_t quantityOf(const std::string& name) {
  const auto* const found = std::ranges::find(kAtlasQuantityNames, name);
  if (found == kAtlasQuantityNames.end()) {
    throw std::invalid_argument("regions: quantity \"" + name + "\" must be F, gradient or Hessian");
  }
  return static_cast<std::size_t>(found - kAtlasQuantityNames.begin());
}

ScalarType scalarOf(const std::string& name) {
  for (const ScalarType scalar : {ScalarType::kFloat, ScalarType::kDouble, ScalarType::kLongDouble}) {
    if (name == nameOf(scalar)) return scalar;
  }
  throw std::invalid_argument("regions: scalar \"" + name + "\" must be float, double or long double");
}

}  // namespace

ResultTable regionTable(const Atlas& atlas) {
  ResultTable table({"map", "formula", "scalar", "quantity", "tolerance", "share_of_map", "safe_where", "fresh_inputs",
                     "violations"});
  for (const SafetyStatement& s : atlas.statements) {
    const StabilityMap& map = *std::ranges::find(atlas.maps, s.map, &StabilityMap::file);
    table.add({s.map, s.formula, std::string(nameOf(s.scalar)), std::string(kAtlasQuantityNames[s.quantity]),
               s.tolerance, s.region ? s.region->share : 0.0, textOf(s.region, map.x, map.y), s.checked, s.violations});
  }
  return table;
}

std::string regionsJson(const std::vector<SafetyStatement>& statements) {
  // A line for each: the file is under version control.
  std::string text = "[";
  for (const SafetyStatement& s : statements) {
    const Json statement = {{"map", s.map},
                            {"formula", s.formula},
                            {"scalar", nameOf(s.scalar)},
                            {"quantity", kAtlasQuantityNames[s.quantity]},
                            {"tolerance", s.tolerance},
                            {"region", s.region ? regionJson(*s.region) : Json()}};
    text += (text.size() > 1 ? ",\n" : "\n") + statement.dump();
  }
  return text + "\n]\n";
}

std::vector<SafetyStatement> readRegions(std::string_view text) {
  std::vector<SafetyStatement> statements;
  for (const Json& s : Json::parse(text)) {
    SafetyStatement statement;
    statement.map = s.at("map").get<std::string>();
    statement.formula = s.at("formula").get<std::string>();
    statement.scalar = scalarOf(s.at("scalar").get<std::string>());
    statement.quantity = quantityOf(s.at("quantity").get<std::string>());
    statement.tolerance = s.at("tolerance").get<double>();
    if (!s.at("region").is_null()) statement.region = regionOf(s.at("region"));
    statements.push_back(std::move(statement));
  }
  return statements;
}

}  // namespace irradiff
