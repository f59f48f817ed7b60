#pragma once

#include <iosfwd>

namespace irradiff {

/// What proven bounds cost on every family of polygons: time of certifyPolygon at 1e-12 as a ratio to evaluatePolygon,
/// and how many polygons climb above double; the same for partly hidden scenes; and the price of each rung.
void printCertifiedSection(std::ostream& out);

}  // namespace irradiff
