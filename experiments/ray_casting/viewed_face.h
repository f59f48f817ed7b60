#pragma once

#include "derivatives/samples/hemisphere_samples.h"

#include <Eigen/Core>

#include <array>
#include <optional>

namespace irradiff {

/// A triangle of a scene, in the scene's length unit or any other.
struct SceneFace {
  std::array<Eigen::Vector3d, 3> vertices;
  double radiance = 0.0;
};

/// A triangle as seen from one receiver, for directions w in the frame (t, b, n) of the receiver.
///
/// Three planes through the receiver bound its image: w is in it if sides[i].w >= lowest[i] for each. The face is at
/// the distance r along w with 1/r = inverse_distance.w, in the unit of the face: no division.
struct ViewedFace {
  std::array<Eigen::Vector3d, 3> sides;
  std::array<double, 3> lowest{};
  Eigen::Vector3d inverse_distance;
  double radiance = 0.0;
};

/// `lowest` is minus this times |a|_1 |e|_1, for a side of the triangle from a (seen from the receiver) along e: what
/// the rounding of sides[i].w is at most, that of the coordinates seen from the receiver included. Each of the six
/// terms a_i e_j w_k carries 5 roundings; a and e themselves carry 4 in each of their sums of three products, and
/// |a|_1, |e|_1 in the frame are up to sqrt(3) times what they are in the world. That is 15 + 12 + 12 units; one more
/// for what is of second order.
///
/// So whatever hits a triangle in exact arithmetic hits it here, and nothing leaks where triangles share an edge or a
/// vertex, while a silhouette is wider by at most 10^-14 rad.
inline constexpr double kSideRounding = 40 * 0x1p-53;

/// In units of this times what the rounding of coordinates does to the distance of the receiver from a face's plane, a
/// receiver within is taken to be in the plane.
inline constexpr double kPlaneRounding = 8 * 0x1p-53;

/// The face as the receiver sees it; nothing if it has no image: where it does not rise above the horizon, or where the
/// receiver is in its plane to within the rounding of coordinates, as it is on its own surface.
std::optional<ViewedFace> viewedFace(const SceneFace& face, const SampleFrame& frame);

}  // namespace irradiff
