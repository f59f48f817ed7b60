#pragma once

#include "verification/exact_visibility/exact_visibility.h"

#include <string>
#include <vector>

namespace irradiff {

/// "1/4", "-3".
std::string textOf(const ExactRational& number);
/// "(1/2, 0, 1)".
std::string textOf(const ExactVector& vector);
/// "1.2" for edge 2 of polygon 1, "0x1" for the crease of polygons 0 and 1.
std::string textOf(const ExactLine& line);

/// "1.2 [0, 1/4 at 0.3] left 1 right -" for a piece of edge 2 of polygon 1 that ends where edge 3 of polygon 0 crosses
/// it, between polygon 1 and the background. A limit at the horizon is "1/4 horizon"; on creases the point stands for
/// t.
std::string textOf(const ExactArc& arc);
/// "(1/2, 0, 1) 1.2 0.3", the nearest line first; "degenerate" at the end where it is.
std::string textOf(const ExactApparentVertex& vertex);
/// "(0, 1, 1) to (0, -1, 1) polygon 0".
std::string textOf(const ExactHorizonArc& arc);

template <class Part>
std::vector<std::string> textsOf(const std::vector<Part>& parts) {
  std::vector<std::string> texts;
  texts.reserve(parts.size());
  for (const Part& part : parts) texts.push_back(textOf(part));
  return texts;
}

}  // namespace irradiff
