#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace irradiff {

enum class CheckKind {
  kValues,       ///< compares values with an oracle's: errors are relative, norm-wise
  kBounds,       ///< compares the error with the bound that the formula claims
  kConsistency,  ///< compares values of the formula with each other, or with a closed form of some configurations
};

/// What one check can see and what it cannot.
struct CheckExplanation {
  std::string_view check;  ///< as in Verdict::check; "closed form" stands for all that begin with it
  CheckKind kind;
  std::string_view catches;
  std::string_view misses;
};

const std::vector<CheckExplanation>& checkLegend();

/// Throws std::invalid_argument naming the check if there is none: no check goes unexplained.
const CheckExplanation& explanationOf(std::string_view check);

}  // namespace irradiff
