#pragma once

#include "experiments/pareto/family_inputs.h"
#include "experiments/pareto/polygon_methods.h"
#include "experiments/pareto/spread.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace irradiff {

/// Over the inputs that were compared; infinite where a method had no value.
struct ErrorStatistics {
  double median = 0.0;
  double percentile99 = 0.0;  ///< 99 % of the inputs have at most this
  double peak = 0.0;
};

/// Requires errors, none of them NaN.
ErrorStatistics statisticsOf(std::vector<double> errors);

/// A method on the inputs of a family.
struct MethodTrade {
  std::string method;
  MethodGroup group = MethodGroup::kAppendix;
  std::size_t compared = 0;  ///< inputs with an error: those above the horizon for methods that do not cut there
  std::array<ErrorStatistics, 4> errors;  ///< as relativeErrors(); meaningless where nothing was compared
  Spread nanoseconds;                     ///< for a polygon, mean over all inputs
  Spread ratio;                           ///< to the first method's in the same round
  bool on_front = false;                  ///< of time and the 99 % of the largest error
};

struct FamilyTrade {
  std::string family;
  std::string description;
  std::size_t inputs = 0;
  std::vector<MethodTrade> methods;  ///< in the order of polygonMethods()
};

/// Errors of all methods, and their times over `rounds` rounds in which they take turns, on this thread.
FamilyTrade tradeOf(const FamilyInputs& inputs, std::size_t rounds);

}  // namespace irradiff
