#pragma once

#include "derivatives/scene/polygon.h"
#include "verification/multiprecision/multiprecision.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace irradiff {

/// A scene of polygons that may hide each other, for the irradiance at any receiver by the plainest way there is: from
/// every radiating triangle the cone behind every other triangle is cut away, and what remains is added up by Lambert's
/// formula. It follows no edges and knows no arcs, no apparent vertices and no topology; what is seen is found anew at
/// every receiver.
///
/// Which side of a plane a point is on is decided at 200 digits: values below 2^-500 of their terms count as zero.
class CutScene {
 public:
  /// Requires validated polygons. Those in one plane that overlap must have one radiance.
  explicit CutScene(std::span<const Polygon> polygons);

  /// The integral of L w over the directions w above the horizon; irradiance is n.V, the rotational gradient n x V.
  /// Polygons in whose plane the receiver lies neither radiate nor block. W/m^2, right to about 190 digits.
  MultiprecisionVector vectorIrradiance(const MultiprecisionVector& position, const MultiprecisionVector& normal) const;

 private:
  struct Triangle {
    std::array<MultiprecisionVector, 3> vertices;
    std::size_t polygon;
  };

  std::vector<Triangle> triangles_;
  std::vector<Multiprecision> radiances_;  ///< of the polygons
};

}  // namespace irradiff
