#pragma once

#include "derivatives/boundary/vector.h"
#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <array>
#include <cstddef>

namespace irradiff {

/// Polygons with more vertices are left to evaluatePolygon.
inline constexpr std::size_t kMostPlainVertices = 32;

/// A vertex in plain double: relative to the receiver, each component of `position` right to u; `inverse_distance` is
/// 1/|position|, `height` its height n.r over the horizon, `cosine` the quotient of the two.
struct PlainVertex {
  Vector3<double> position;
  double height;
  double inverse_distance;
  double cosine;
};

/// A polygon as plain double sees it, without the heap, in units of 2^exponent metres: the largest component of a
/// position is in [1/2, 1).
struct PlainView {
  enum class Horizon {
    kAbove,      ///< every vertex is above the horizon
    kBelow,      ///< every vertex is below it, farther than rounding reaches
    kCrosses,    ///< it cuts edges, and no vertex lies on it
    kUndecided,  ///< plain double cannot tell, or is out of its range: a matter for evaluatePolygon
  };

  Horizon horizon = Horizon::kUndecided;
  std::size_t count = 0;
  int exponent = 0;
  double scale = 1.0;  ///< 2^-exponent
  std::array<PlainVertex, kMostPlainVertices> vertices;
  /// Largest relative error of a height, in units of u.
  double height_error = 1.0;
  /// Of what is above the horizon, cut there: its vertices, and a bound of the largest distance of one from their mean,
  /// relative to the mean's own.
  std::size_t visible_count = 0;
  double extent = 0.0;
  // Estimates of the same, to choose by and for nothing else.
  double thinness = 0.0;        ///< twice the area over the square of that largest distance
  double sine_to_plane = 0.0;   ///< of the ray to the mean
  double highest_cosine = 0.0;  ///< of the vertices

  std::size_t next(std::size_t i) const { return i + 1 < count ? i + 1 : 0; }
};

/// Heights below `low_sine` are taken from doubled precision. Requires validated arguments and a low_sine in [2^-20,
/// 1].
void lookPlainly(const Polygon& polygon, const Receiver& receiver, double low_sine, PlainView& view);

}  // namespace irradiff
