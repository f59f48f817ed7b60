#pragma once

#include "verification/checks/oracle.h"
#include "verification/reference/reference_data.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// The 40-digit values of data/reference as an oracle and its inputs by family. Made by enclosures and 200-digit
/// differences of the defining area integral: catches a wrong F, gradient or Hessian, and rounding.
class ReferenceOracle {
 public:
  /// Reads all polygon cases of the folder; throws InvalidReference.
  explicit ReferenceOracle(const std::filesystem::path& folder);

  /// Knows only the configurations of inputs(). Refers to this object.
  Oracle oracle() const;
  const std::map<std::string, std::vector<Configuration>>& inputsByFamily() const { return inputs_; }

 private:
  std::vector<ReferenceCase> cases_;
  std::map<std::string, std::size_t> case_of_line_;
  std::map<std::string, std::vector<Configuration>> inputs_;
};

}  // namespace irradiff
