#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace irradiff {

/// A reference case before its values: a polygon, a receiver and why they are worth having.
struct ReferenceInput {
  std::string name;
  std::string reason;
  std::vector<Eigen::Vector3d> vertices;
  Eigen::Vector3d position;
  Eigen::Vector3d normal;
};

struct FlatlandReferenceInput {
  std::string name;
  std::string reason;
  std::array<Eigen::Vector2d, 2> vertices;
  Eigen::Vector2d position;
  Eigen::Vector2d normal;
};

/// One file of reference data.
template <class Input>
struct ReferenceFamily {
  std::string name;
  std::vector<Input> inputs;
};
using PolygonFamily = ReferenceFamily<ReferenceInput>;
using FlatlandFamily = ReferenceFamily<FlatlandReferenceInput>;

/// Generic polygons, edges from tiny to huge against their distance, other units of length, places far from the origin.
std::vector<PolygonFamily> regularFamilies();
/// The receiver near an edge, a vertex, the plane, the line of an edge; slivers.
std::vector<PolygonFamily> singularFamilies();
/// Polygons cut by the horizon.
std::vector<PolygonFamily> horizonFamilies();
FlatlandFamily flatlandFamily();

/// The same inputs, each with its vertices in the order that makes F positive, judged by the sum of r_0.(r_i x
/// r_(i+1)).
PolygonFamily facingReceiver(PolygonFamily family);

/// One significant digit, "1e-12": for names.
std::string scientific(double value);

}  // namespace irradiff
