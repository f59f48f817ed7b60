#include "derivatives/samples/sample_pattern.h"

#include "derivatives/samples/philox.h"

#include <array>
#include <cmath>
#include <limits>

namespace irradiff {

namespace {

constexpr int kFractionBits = 53;
constexpr std::uint64_t kFractionMask = (std::uint64_t{1} << kFractionBits) - 1;

/// Two coordinates in [0, 1) in units of 2^-53, which a double holds exactly.
struct FixedPoint {
  std::uint64_t along_row, along_column;
};

FixedPoint randomPoint(std::uint64_t seed, std::uint64_t point, std::uint64_t sample) {
  const auto low = [](std::uint64_t number) { return static_cast<std::uint32_t>(number); };
  const auto high = [](std::uint64_t number) { return static_cast<std::uint32_t>(number >> 32); };
  const std::array<std::uint32_t, 4> bits =
      philox4x32({low(sample), high(sample), low(point), high(point)}, {low(seed), high(seed)});
  const auto joined = [](std::uint32_t upper, std::uint32_t lower) {
    return ((std::uint64_t{upper} << 32) | lower) >> (64 - kFractionBits);
  };
  return {joined(bits[0], bits[1]), joined(bits[2], bits[3])};
}

/// The digits of `index` act on the columns of the generator matrices: those of the first dimension mirror the digits
/// at the binary point, those of the second are Pascal's triangle modulo 2.
FixedPoint sobolPoint(std::uint32_t index) {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::uint32_t first_column = std::uint32_t{1} << 31;
  std::uint32_t second_column = first_column;
  for (; index != 0; index >>= 1) {
    if ((index & 1) != 0) {
      first ^= first_column;
      second ^= second_column;
    }
    first_column >>= 1;
    second_column ^= second_column >> 1;
  }
  constexpr int kMissingBits = kFractionBits - 32;
  return {std::uint64_t{first} << kMissingBits, std::uint64_t{second} << kMissingBits};
}

StratumOffset inUnitSquare(const FixedPoint& point) {
  return {std::ldexp(static_cast<double>(point.along_row), -kFractionBits),
          std::ldexp(static_cast<double>(point.along_column), -kFractionBits)};
}

// No sample has this number.
constexpr std::uint64_t kShiftOfPoint = std::numeric_limits<std::uint64_t>::max();

}  // namespace

StratumOffset stratumOffset(SamplePattern pattern, std::uint64_t seed, std::uint64_t point, std::uint64_t sample) {
  switch (pattern) {
    case SamplePattern::kCentred:
      return {};
    case SamplePattern::kJittered:
      return inUnitSquare(randomPoint(seed, point, sample));
    case SamplePattern::kLowDiscrepancy:
      break;
  }
  const FixedPoint shift = randomPoint(seed, point, kShiftOfPoint);
  const FixedPoint sobol = sobolPoint(static_cast<std::uint32_t>(sample));
  return inUnitSquare(
      {(sobol.along_row + shift.along_row) & kFractionMask, (sobol.along_column + shift.along_column) & kFractionMask});
}

}  // namespace irradiff
