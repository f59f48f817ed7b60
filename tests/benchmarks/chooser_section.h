#pragma once

#include <iosfwd>

namespace irradiff {

/// What evaluatePolygon saves where it is given a tolerance, on each family of inputs, and what it costs to choose.
void printChooserSection(std::ostream& out);

}  // namespace irradiff
