#include "verification/report/gap_filling_losses.h"

namespace irradiff {

std::vector<GapFillingLosses> measureGapFillingLosses(std::size_t scenes, std::uint64_t seed) {
  std::vector<GapFillingLosses> all;
  for (const SceneFamily& family : sceneFamilies()) {
    all.push_back({std::string(family.name), std::string(family.description), gapFillingErrors(family, scenes, seed)});
  }
  return all;
}

}  // namespace irradiff
