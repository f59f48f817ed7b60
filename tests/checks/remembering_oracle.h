#pragma once

#include "verification/checks/configuration.h"
#include "verification/checks/oracle.h"

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace irradiff {

/// The oracle with its answers remembered: tests ask the same of it for every twin and mutant. Copies share what they
/// know.
inline Oracle remembering(const Oracle& oracle) {
  const auto known = std::make_shared<std::map<std::string, std::optional<OracleValue>>>();
  Oracle result = oracle;
  result.evaluate = [evaluate = oracle.evaluate, known](const Configuration& configuration) {
    const std::string line = sceneLine(configuration);
    const auto found = known->find(line);
    return found != known->end() ? found->second : known->emplace(line, evaluate(configuration)).first->second;
  };
  return result;
}

}  // namespace irradiff
