#pragma once

#include <cstddef>
#include <string_view>

namespace irradiff {

/// How the hemisphere of directions above a receiver is divided into strata, one sample in each. Strata are numbered
/// row by row.
///
/// A right-handed frame (tangent t, bitangent b, normal n) names the directions:
/// - polar: rows are rings of equal projected solid angle from n outward, columns equal azimuths from t towards b
///   (Ward and Heckbert 1992);
/// - concentric: the square [-1, 1]^2 mapped to the unit disk of the t, b plane (Shirley and Chiu 1997) and projected
///   up to the hemisphere: columns run along t, rows along b; all strata have the same projected solid angle;
/// - hemicube of resolution n: shape (3 n, n): the top face (n rows: columns along t, rows along b), then the half
///   faces +t, +b, -t, -b (n/2 rows each, from the horizon up; columns counterclockwise seen from above); texels are
///   squares of side 2/n on the faces of the cube |x|, |y| <= 1, 0 <= z <= 1.
enum class Stratification { kPolar, kConcentric, kHemicube };

/// As files and messages have it: "polar", "concentric", "hemicube".
constexpr std::string_view nameOf(Stratification stratification) {
  switch (stratification) {
    case Stratification::kPolar:
      return "polar";
    case Stratification::kConcentric:
      return "concentric";
    case Stratification::kHemicube:
      break;
  }
  return "hemicube";
}

/// Numbers of rows and of columns of strata.
struct GridShape {
  std::size_t rows = 0;
  std::size_t columns = 0;

  std::size_t size() const { return rows * columns; }
  bool operator==(const GridShape&) const = default;
};

}  // namespace irradiff
