#pragma once

#include "derivatives/scene/polygon.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace irradiff {

/// Where the topology of a view may change for receivers of one normal in one plane, because a vertex passes behind an
/// edge or a polygon turns its other side: the planes through a vertex of one polygon and an edge of another, and those
/// of the polygons. Not among them are planes parallel to the receivers', which these never cross, and the surfaces
/// through three edges.
class EventPlanes {
 public:
  EventPlanes(std::span<const Polygon> polygons, const Eigen::Vector3d& receivers_normal);

  /// Distance of a point from the nearest one. Metres.
  double distance(const Eigen::Vector3d& point) const;

 private:
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

  struct Plane {
    Eigen::Vector3d point;
    Eigen::Vector3d unit_normal;
  };
  Eigen::Vector3d receivers_normal_;
  std::vector<Plane> planes_;
};

}  // namespace irradiff
