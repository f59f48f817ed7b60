#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <string_view>

namespace irradiff {

/// SplitMix64 (Steele, Lea, Flood 2014) started from a key: what is drawn depends on seed, stream and index alone, on
/// every platform.
class KeyedRandom {
 public:
  KeyedRandom(std::uint64_t seed, std::string_view stream, std::uint64_t index) : state_(seed) {
    for (const char c : stream) {
      state_ = next() ^ static_cast<unsigned char>(c);
    }
    state_ = next() ^ index;
    next();
  }

  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
  }

  /// In [0, 1).
  double unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// 10 to a power drawn evenly.
  double decade(double low, double high) { return std::pow(10.0, between(low, high)); }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }

  /// Evenly distributed over the sphere.
  Eigen::Vector3d direction() {
    Eigen::Vector3d v;
    do {
      v = {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)};
    } while (v.squaredNorm() > 1.0 || v.squaredNorm() < 1e-4);
    return v.normalized();
  }

 private:
  std::uint64_t state_;
};

}  // namespace irradiff
