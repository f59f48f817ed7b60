#pragma once

#include "tests/mutants/formula_entry_points.h"
#include "verification/checks/candidate.h"
#include "verification/checks/flatland_suite.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace irradiff {

/// The groups of formulas, each with a shared object of its own.
enum class FormulaGroup {
  kBoundary,    ///< boundaryFormFactor and what it sums
  kAppendix,    ///< appendixFormFactor
  kProduction,  ///< evaluatePolygon
  kSegment,     ///< evaluateSegment
};

/// One group of formulas, of a mutant or unmutated, in a shared object that stays loaded for as long as this or a
/// candidate made of it lives.
class FormulaLibrary {
 public:
  /// Throws std::runtime_error, with the loader's message, if the file cannot be loaded.
  FormulaLibrary(std::string name, FormulaGroup group, const std::filesystem::path& file);

  /// The mutation's, or "unmutated".
  const std::string& name() const { return name_; }
  FormulaGroup group() const { return group_; }

  /// Bounds for kProduction alone, tangential Hessian and rotational gradient for that and kEdgeTerms. Requires a
  /// formula of the group.
  Candidate candidate(PolygonFormula formula) const;
  /// Requires kSegment.
  FlatlandCandidate flatlandCandidate() const;

 private:
  FormulaAnswer ask(PolygonFormula formula, const Configuration& configuration) const;
  FormulaAnswer ask(const FlatlandConfiguration& configuration) const;

  std::string name_;
  FormulaGroup group_;
  std::shared_ptr<void> handle_;
  decltype(&answerPolygon) answer_polygon_ = nullptr;
  decltype(&answerSegment) answer_segment_ = nullptr;
};

/// Those of the folder's libraries.txt, a line each: a name, a dot and a group. Throws std::runtime_error if that file
/// or a shared object is missing, or a group is unknown.
std::vector<FormulaLibrary> loadFormulaLibraries(const std::filesystem::path& folder);

}  // namespace irradiff
