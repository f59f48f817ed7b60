#include "data/reference/reference_inputs.h"

namespace irradiff {

namespace {

using Vertices = std::vector<Eigen::Vector3d>;

const Eigen::Vector3d kUp(0, 0, 1);

PolygonFamily straddling() {
  PolygonFamily family{"horizon", {}};
  const Eigen::Vector3d tilted = Eigen::Vector3d(0.6, 0.2, 0.7).normalized();
  family.inputs.push_back({"triangle",
                           "one corner below the horizon",
                           {{1, -0.7, 0.6}, {1.2, 0.8, 0.5}, {0.9, 0.1, -0.7}},
                           {0, 0, 0},
                           kUp});
  family.inputs.push_back({"two_below",
                           "two corners below the horizon",
                           {{1, -0.7, -0.6}, {1.2, 0.8, -0.5}, {0.9, 0.1, 0.7}},
                           {0, 0, 0},
                           kUp});
  family.inputs.push_back(
      {"wall", "a wall half below the horizon", {{1, -1, -0.5}, {1, 1, -0.5}, {1, 1, 1}, {1, -1, 1}}, {0, 0, 0}, kUp});
  family.inputs.push_back({"ceiling_tilted",
                           "a ceiling cut by the horizon of a tilted receiver",
                           {{-1.5, -1, 1}, {1.2, -1, 1}, {1.2, 1.3, 1}, {-1.5, 1.3, 1}},
                           {0, 0, 0},
                           tilted});
  family.inputs.push_back(
      {"two_parts",
       "a U cut by the horizon into two visible parts",
       {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, 0.4, 1}, {1, 0.4, -0.4}, {1, -0.4, -0.4}, {1, -0.4, 1}, {1, -1, 1}},
       {0, 0, 0},
       kUp});
  for (const double corner : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    family.inputs.push_back({"visible_corner_" + scientific(corner),
                             "only " + scientific(corner) + " of the edges is above the horizon",
                             {{1, 0.2, corner}, {1.3, 1, -1}, {0.8, -0.9, -1.2}},
                             {0, 0, 0},
                             kUp});
  }
  // For the doubles next to 0.6 and 0.8 two of the products cancel to 2^-105; their sum with the third has too many
  // bits for two doubles.
  const double ulp = 0x1p-53;
  family.inputs.push_back(
      {"visible_corner_2e-22",
       "only 2e-22 of the edges is above the horizon: the height is that of the least of three products",
       {{0.8 - 4 * ulp + 0.0625, 0.45, -0.6 + 3 * ulp - 0.125}, {1.3, 1, -1.7}, {0.8, -0.9, -1.2}},
       {0.0625, 0.25, -0.125},
       {0.6, 1.1 * 0x1p-70, 0.8}});
  family.inputs.push_back({"invisible_corner_1e-10",
                           "a corner of 1e-10 is below the horizon",
                           {{1, 0.2, -1e-10}, {1.3, 1, 1}, {0.8, -0.9, 1.2}},
                           {0, 0, 0},
                           kUp});
  family.inputs.push_back({"skimming_1e-10",
                           "an edge of length 1.5 is 1e-10 above the horizon",
                           {{1, -0.7, 1e-10}, {1.2, 0.8, 2e-10}, {0.9, 0.1, 0.7}},
                           {0, 0, 0},
                           kUp});
  return family;
}

PolygonFamily tinyAtHorizon() {
  PolygonFamily family{"tiny_at_horizon", {}};
  const Vertices triangle{{0.1, -0.5, 0.3}, {-0.2, 0.6, 0.4}, {0.05, 0.15, -0.5}};
  for (const double size : {1e-2, 1e-4, 1e-6}) {
    Vertices small;
    for (const Eigen::Vector3d& vertex : triangle) small.emplace_back(Eigen::Vector3d(0.8, 0.6, 0) + size * vertex);
    family.inputs.push_back(
        {"triangle_" + scientific(size),
         "a triangle of size " + scientific(size) + " at distance 1 cut by the horizon: the sums over its edges cancel",
         small,
         {0, 0, 0},
         kUp});
  }
  for (const double corner : {1e-3, 1e-7}) {
    const double size = 1e-4;
    Vertices small{{0.8, 0.6, -corner * size},
                   {0.8 - 0.6 * size, 0.6 + 0.8 * size, size},
                   {0.8 + 0.5 * size, 0.6 - 0.9 * size, size}};
    family.inputs.push_back(
        {"invisible_corner_" + scientific(corner),
         "a triangle of size 1e-4 with a corner of " + scientific(corner) + " of its size below the horizon",
         small,
         {0, 0, 0},
         kUp});
  }
  return family;
}

}  // namespace

std::vector<PolygonFamily> horizonFamilies() { return {facingReceiver(straddling()), facingReceiver(tinyAtHorizon())}; }

}  // namespace irradiff
