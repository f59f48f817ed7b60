#pragma once

#include <string>

namespace irradiff {

/// The text of data/samples/figure5_concentric_16x16.json: jittered samples of data/scenes/figure5.json at a receiver
/// beside the shadows, seen by rays that meet one polygon after the other.
std::string exampleSamplesText();

}  // namespace irradiff
