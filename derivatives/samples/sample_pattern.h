#pragma once

#include <cstdint>

namespace irradiff {

/// Where in its stratum a sample is.
enum class SamplePattern {
  kCentred,         ///< in the middle
  kJittered,        ///< uniformly at random
  kLowDiscrepancy,  ///< by Sobol's sequence in the order of strata, shifted at random as a whole for each point
};

/// A place in a stratum, both coordinates in [0, 1).
struct StratumOffset {
  double along_row = 0.5;
  double along_column = 0.5;
};

/// The offset of sample number `sample` of point number `point`: a function of the arguments alone, so that samples can
/// be drawn in any order and by any number of threads. Requires sample < 2^32.
///
/// Random numbers are those of philox.h with the seed as key and (sample, point) as counter. The low-discrepancy
/// sequence is the first two dimensions of Sobol's (1967), a (0, 2)-sequence in base 2 (Kollig and Keller, "Efficient
/// Multidimensional Sampling", 2002, section 3); it is shifted modulo 1 (Cranley and Patterson 1976), which leaves
/// every single sample uniform.
StratumOffset stratumOffset(SamplePattern pattern, std::uint64_t seed, std::uint64_t point, std::uint64_t sample);

}  // namespace irradiff
