#pragma once

#include "verification/occlusion/gap_filling.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace irradiff {

/// What filling gaps loses of the Hessian in the scenes of one family.
struct GapFillingLosses {
  std::string family;
  std::string description;
  GapFillingErrors losses;
};

/// Of `scenes` scenes of every family.
std::vector<GapFillingLosses> measureGapFillingLosses(std::size_t scenes, std::uint64_t seed);

}  // namespace irradiff
