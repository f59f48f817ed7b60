#pragma once

#include "verification/checks/configuration.h"

#include <string>
#include <vector>

namespace irradiff {

class KeyedRandom;

/// One size on which the difficulty of a polygon depends, swept over decades with everything else drawn at random.
struct SweepInputs {
  std::string name;        ///< "edge over distance"
  std::string file;        ///< "edge_over_distance"
  std::string axis_title;  ///< with its unit
  std::string description;
  int first_decade;
  int last_decade;
  bool is_above_horizon;    ///< all of the polygon is: formulas that know no horizon apply
  double gradient_promise;  ///< of the production path; 0 where only the reported bound is promised
  double hessian_promise;
  Configuration (*draw)(KeyedRandom&, double size);
};

const std::vector<SweepInputs>& sweepInputs();

}  // namespace irradiff
