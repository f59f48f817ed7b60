#pragma once

#include "tests/mutants/formula_entry_points.h"
#include "verification/checks/candidate.h"
#include "verification/checks/flatland_suite.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace irradiff {

/// The formulas of one mutant, or unmutated, in shared objects loaded for as long as this or a candidate made of it
/// lives. Each group of formulas has its own: what does not see the mutated file is the unmutated one.
class FormulaLibrary {
 public:
  /// `libraries` maps the groups "production", "templated" and "segment" to files. Throws std::runtime_error, with the
  /// loader's message, if one cannot be loaded.
  FormulaLibrary(std::string name, const std::map<std::string, std::filesystem::path>& libraries);

  const std::string& name() const { return name_; }

  /// The polygon formula; bounds for kProduction alone, no form factor for kEdgeTerms.
  Candidate candidate(PolygonFormula formula) const;
  FlatlandCandidate flatlandCandidate() const;

  /// The rotational gradient of F (1/rad) of kProduction, and in flatland that of irradiance.
  Eigen::Vector3d rotationalGradient(const Configuration& configuration) const;
  double rotationalGradient(const FlatlandConfiguration& configuration) const;

 private:
  using PolygonEntry = decltype(&answerPolygon);
  using SegmentEntry = decltype(&answerSegment);

  FormulaAnswer ask(PolygonFormula formula, const Configuration& configuration) const;
  FormulaAnswer ask(const FlatlandConfiguration& configuration) const;

  std::string name_;
  std::vector<std::shared_ptr<void>> handles_;
  PolygonEntry production_ = nullptr;
  PolygonEntry templated_ = nullptr;
  SegmentEntry segment_ = nullptr;
};

/// The folder's unmutated formulas first, then each mutant in the order of the folder's libraries.txt. Throws
/// std::runtime_error if that file or a shared object is missing.
std::vector<FormulaLibrary> loadFormulaLibraries(const std::filesystem::path& folder);

}  // namespace irradiff
