#pragma once

#include "verification/checks/configuration.h"

#include <array>
#include <string>
#include <vector>

namespace irradiff {

class KeyedRandom;

/// A size that is varied over decades.
struct AtlasAxis {
  std::string name;  ///< "edge/distance": a ratio of lengths, or a sine
  double low = 0.0;
  double high = 1.0;
};

/// Two sizes on which the difficulty of a polygon depends, varied against each other with all else drawn at random.
struct PolygonMap {
  std::string file;   ///< "size_grazing"
  std::string title;  ///< a phrase
  std::string description;
  AtlasAxis x, y;
  /// A triangle above the horizon of its receiver, in no special direction; both pass `validate`. The world's origin is
  /// at the polygon or at what is near the receiver, where coordinates have their finest steps.
  Configuration (*draw)(KeyedRandom& random, double x, double y);
  /// The two sizes as the rounded coordinates have them.
  std::array<double, 2> (*measure)(const Configuration& input);
};

const std::vector<PolygonMap>& polygonMaps();

/// The input with all coordinates rounded to float, held in doubles: what float variants are given, and what their
/// error is measured against. NaN in the place of a coordinate beyond the range of normal floats. The normal is then a
/// unit vector to float precision only; F is linear in it.
Configuration roundedToFloat(const Configuration& input);

/// Whether a place is the wanted one to a quarter, in both sizes; false for NaN.
bool isHeldAt(const std::array<double, 2>& place, double x, double y);

/// Whether the input is what the place (x, y) of the map stands for: both sizes are right to a quarter, and the polygon
/// is above the horizon. Rounding to float moves many an input elsewhere, or onto a line.
bool isHeld(const PolygonMap& map, const Configuration& input, double x, double y);

}  // namespace irradiff
