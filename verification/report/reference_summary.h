#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace irradiff {

/// The reference cases of one family: how many there are and by which routes their values were found.
struct ReferenceSummary {
  std::string family;
  int dimension = 3;
  std::map<std::string, std::size_t> cases_by_route;

  std::size_t cases() const;
};

/// Throws InvalidReference.
std::vector<ReferenceSummary> summariseReferences(const std::filesystem::path& folder);

}  // namespace irradiff
