#include "data/reference/reference_inputs.h"

namespace irradiff {

namespace {

using Vertices = std::vector<Eigen::Vector3d>;

const Eigen::Vector3d kUp(0, 0, 1);

PolygonFamily nearEdge() {
  PolygonFamily family{"near_edge", {}};
  const Eigen::Vector3d tilted = Eigen::Vector3d(0.2, 0.6, 0.7).normalized();
  for (const double distance : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const double y = 0.6 * distance;
    const double z = 0.8 * distance;
    family.inputs.push_back({"triangle_" + scientific(distance),
                             "receiver " + scientific(distance) + " from an edge, beside the polygon",
                             {{-1, y, z}, {1, y, z}, {0.2, 1.5, 0.7}},
                             {0, 0, 0},
                             kUp});
  }
  family.inputs.push_back({"under_triangle_1e-12",
                           "receiver 1e-12 from an edge, under the polygon",
                           {{-1, -6e-13, 8e-13}, {1.2, -6e-13, 8e-13}, {0.2, 1.5, 0.7}},
                           {0, 0, 0},
                           kUp});
  family.inputs.push_back({"quad_1e-12",
                           "receiver 1e-12 from an edge of a quadrilateral, normal tilted",
                           {{-1, 6e-13, 8e-13}, {1.2, 6e-13, 8e-13}, {1.3, 1.5, 0.7}, {-0.9, 1.5, 0.7}},
                           {0, 0, 0},
                           tilted});
  // With the receiver at the origin "vertex minus receiver" is exact in double; here it is not.
  const Eigen::Vector3d start(-0.7, 0.3, 0.9);
  const Eigen::Vector3d end(1.1, 0.8, 1.3);
  const Eigen::Vector3d beside = start + 0.4 * (end - start) - 1e-9 * Eigen::Vector3d(0, 0.6, 0.8);
  family.inputs.push_back({"off_origin_1e-09",
                           "receiver 1e-9 from an edge, the differences of coordinates not representable",
                           {start, end, {0.2, 1.9, 1.7}},
                           beside,
                           kUp});
  return family;
}

PolygonFamily nearVertex() {
  PolygonFamily family{"near_vertex", {}};
  // Nearer than the squared unit roundoff, r x e is known at the near end of an edge alone.
  for (const double distance : {1e-4, 1e-8, 1e-12, 1e-20, 1e-30}) {
    const Eigen::Vector3d corner = distance * Eigen::Vector3d(0.48, -0.36, 0.8);
    family.inputs.push_back({"triangle_" + scientific(distance),
                             "receiver " + scientific(distance) + " from a vertex",
                             {corner, {1, 0.4, 0.5}, {-0.3, 1.1, 0.9}},
                             {0, 0, 0},
                             kUp});
  }
  const Eigen::Vector3d corner(-3e-13, 5e-13, 8e-13);
  const Eigen::Vector3d u(0.9, 0.1, 0.3);
  const Eigen::Vector3d v(-0.1, 0.8, 0.4);
  family.inputs.push_back({"reentrant_1e-12",
                           "receiver 1e-12 from the reentrant vertex of a dart",
                           {corner, corner + u - 0.5 * v, corner + 0.1 * u + 1.5 * v, corner - u - 0.6 * v},
                           {0, 0, 0},
                           kUp});
  return family;
}

PolygonFamily nearPlane() {
  PolygonFamily family{"near_plane", {}};
  const Eigen::Vector3d tilted = Eigen::Vector3d(0.5, -0.3, 0.8).normalized();
  for (const double height : {1e-6, 1e-9, 1e-12}) {
    const Vertices triangle{{-1, -0.8, height}, {1.1, -0.6, height}, {0.2, 1.3, height}};
    family.inputs.push_back({"inside_" + scientific(height),
                             "foot inside the polygon at height " + scientific(height) +
                                 ": F close to 1, the gradient small against its terms",
                             triangle,
                             {0, 0, 0},
                             kUp});
    family.inputs.push_back({"outside_" + scientific(height),
                             "foot outside the polygon, height " + scientific(height) + ", normal tilted",
                             triangle,
                             {-1.5, 0.4, 0},
                             tilted});
  }
  family.inputs.push_back({"inside_tilted_1e-12",
                           "foot inside, normal tilted: the horizon passes 1e-12 from the receiver",
                           {{-1, -0.8, 1e-12}, {1.1, -0.6, 1e-12}, {0.2, 1.3, 1e-12}},
                           {0, 0, 0},
                           tilted});
  return family;
}

PolygonFamily gradientNearPlane() {
  PolygonFamily family{"gradient_near_plane", {}};
  for (const double height : {1e-6, 1e-7, 1e-10}) {
    const Vertices square{{-1, -0.8, height}, {1.1, -0.8, height}, {1.1, 0.9, height}, {-1, 0.9, height}};
    family.inputs.push_back({"square_" + scientific(height),
                             "the gradient is of the order of the height, its terms of order 1",
                             square,
                             {0.1, 0.05, 0},
                             kUp});
  }
  return family;
}

PolygonFamily nearRadial() {
  PolygonFamily family{"near_radial", {}};
  const Eigen::Vector3d tilted = Eigen::Vector3d(0.4, -0.3, 0.8).normalized();
  const Eigen::Vector3d direction(0.64, 0.48, 0.6);
  const Eigen::Vector3d aside(-0.6, 0.8, 0);
  for (const double sine : {1e-3, 1e-6, 1e-9, 1e-12}) {
    // From r to r + 1.5 direction + tilt: the line passes the receiver at about `sine`.
    family.inputs.push_back({"triangle_" + scientific(sine),
                             "an edge that points at the receiver but for a sine of " + scientific(sine),
                             {direction, 2.5 * direction + 1.5 * sine * aside, {-0.3, 1.2, 1.4}},
                             {0, 0, 0},
                             kUp});
  }
  family.inputs.push_back({"long_1e-12",
                           "the same, the edge 1e3 times as long as its distance",
                           {direction, 1e3 * direction + 1e-9 * aside, {-0.3, 1.2, 1.4}},
                           {0, 0, 0},
                           tilted});
  const Eigen::Vector3d far = 2.5 * direction + 1.5e-12 * aside;
  const Eigen::Vector3d third(-0.7, 3.0, 2.6);
  family.inputs.push_back({"quad_1e-12",
                           "an edge of a trapezoid points at the receiver but for a sine of 1e-12",
                           {direction, far, third, direction + 0.4 * (third - far)},
                           {0, 0, 0},
                           kUp});
  family.inputs.push_back(
      {"on_extension",
       "receiver exactly on the line of an edge, hence in the polygon's plane: F = 0, its derivatives are not",
       {{1, 0.5, 1}, {2, 1, 2}, {1, -0.75, 1.5}},
       {0, 0, 0},
       kUp});
  family.inputs.push_back({"on_extension_long",
                           "the same for an edge four times its distance",
                           {{0.5, 0.25, 0.5}, {2.5, 1.25, 2.5}, {1, -0.75, 1.5}},
                           {0, 0, 0},
                           tilted});
  return family;
}

PolygonFamily slivers() {
  PolygonFamily family{"sliver", {}};
  for (const double width : {1e-6, 1e-9, 1e-12}) {
    family.inputs.push_back({"triangle_" + scientific(width),
                             "a triangle of aspect 1 to " + scientific(width),
                             {{-0.5, 0.25, 1}, {0.5, 0.25, 1.25}, {0.5, 0.25 + width, 1.25}},
                             {0, 0, 0},
                             kUp});
  }
  family.inputs.push_back({"blade_1e-09",
                           "a quadrilateral 1e-9 wide, seen at an angle",
                           {{-1, 0.3, 0.7}, {1, 0.5, 0.9}, {1, 0.5, 0.9 + 1e-9}, {-1, 0.3, 0.7 + 1e-9}},
                           {0, 0, 0},
                           kUp});
  family.inputs.push_back({"blade_straddling_1e-09",
                           "a quadrilateral 1e-9 wide, cut by the horizon",
                           {{1, 0.3, 0.7}, {1, 0.5, -0.9}, {1, 0.5 + 1e-9, -0.9}, {1, 0.3 + 1e-9, 0.7}},
                           {0, 0, 0},
                           kUp});
  return family;
}

}  // namespace

std::vector<PolygonFamily> singularFamilies() {
  return {facingReceiver(nearEdge()),          facingReceiver(nearVertex()), facingReceiver(nearPlane()),
          facingReceiver(gradientNearPlane()), facingReceiver(nearRadial()), facingReceiver(slivers())};
}

}  // namespace irradiff
