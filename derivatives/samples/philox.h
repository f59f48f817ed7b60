#pragma once

#include <array>
#include <cstdint>

namespace irradiff {

/// Philox4x32-10 of Salmon, Moraes, Dror and Shaw, "Parallel Random Numbers: As Easy as 1, 2, 3" (2011), section 4.3:
/// 128 random bits that are a function of a 128-bit counter and a 64-bit key alone.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

}  // namespace irradiff
