#pragma once

#include "tests/mutants/formula_library.h"
#include "verification/checks/oracle.h"
#include "verification/checks/reference_oracle.h"
#include "verification/checks/verdict.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace irradiff {

/// The checks that every mutant goes through: those of verification/checks over few inputs. What the oracles know about
/// an input is computed once for all mutants.
class MutantChecks {
 public:
  /// Throws InvalidReference if the folder's references cannot be read.
  MutantChecks(std::filesystem::path reference_folder, std::uint64_t seed);

  /// Everything that is promised of the group: one verdict for each formula, check, family and quantity.
  std::vector<Verdict> run(const FormulaLibrary& formulas) const;

 private:
  struct Extent;

  /// The checks of one formula of a polygon that extent asks for.
  void addPolygonVerdicts(const Candidate& candidate, const Extent& extent, std::vector<Verdict>& verdicts) const;

  std::filesystem::path reference_folder_;
  std::uint64_t seed_;
  ReferenceOracle references_;
  /// The oracles, each remembering what it was asked before.
  Oracle stored_, rounding_, jets_, gradient_jets_, differences_, enclosures_;
};

/// Whether the check's expected values come from the templates of derivatives/ themselves. A mutation of a template
/// would change them too, if it were not for the mutants: what catches mistakes in the code as it stands is the others.
bool trustsTheFormulas(const Verdict& verdict);

}  // namespace irradiff
