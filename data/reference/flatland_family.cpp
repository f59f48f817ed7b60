#include "data/reference/reference_inputs.h"

#include <algorithm>
#include <cmath>

namespace irradiff {

FlatlandFamily flatlandFamily() {
  const Eigen::Vector2d up(0, 1);
  const Eigen::Vector2d tilted = Eigen::Vector2d(0.4, 0.9).normalized();
  FlatlandFamily family{
      "flatland",
      {{"overhead", "a segment at height 1", {{{-0.5, 1}, {0.5, 1}}}, {0, 0}, up},
       {"slanted", "a slanted segment, receiver turned", {{{-0.7, 0.4}, {1.1, 1.3}}}, {0.1, -0.2}, tilted},
       {"wall", "a wall above the floor", {{{1, 0.25}, {1, 2}}}, {0, 0}, up},
       {"straddling", "a wall cut by the horizon", {{{1, -0.6}, {1.2, 0.9}}}, {0, 0}, up},
       {"straddling_tilted",
        "a ceiling cut by the horizon of a tilted receiver",
        {{{-3, 1}, {2, 1.1}}},
        {0, 0},
        tilted},
       {"visible_corner_1e-10",
        "only 1e-10 of the segment is above the horizon",
        {{{1, 1e-10}, {1.3, -1}}},
        {0, 0},
        up},
       {"invisible_corner_1e-10",
        "all but 1e-10 of the segment is above the horizon",
        {{{1, -1e-10}, {1.3, 1}}},
        {0, 0},
        up},
       {"near_end_1e-12", "receiver 1e-12 from an end", {{{6e-13, 8e-13}, {1, 1.5}}}, {0, 0}, up},
       {"near_line_1e-12", "receiver 1e-12 under the segment", {{{-1, 1e-12}, {0.7, 1e-12}}}, {0, 0}, up},
       {"near_line_tilted_1e-12",
        "receiver 1e-12 from the segment, tilted: cut by the horizon near the receiver",
        {{{-1, 1e-12}, {0.7, 1e-12}}},
        {0, 0},
        tilted},
       {"near_radial_1e-12",
        "the segment points at the receiver but for a sine of 1e-12",
        {{{0.6, 0.8}, {1.8 - 8e-13, 2.4 + 6e-13}}},
        {0, 0},
        up}}};
  for (const double size : {1e-8, 0.05, 1e6}) {
    family.inputs.push_back({"size_" + scientific(size),
                             "length " + scientific(size) + " times the distance",
                             {{{0.4 - 0.3 * size, 0.9}, {0.4 + 0.5 * size, 0.9 + 0.1 * std::min(size, 1.0)}}},
                             {0, 0},
                             up});
  }
  for (const int exponent : {498, -498}) {
    const double scale = std::ldexp(1.0, exponent);
    family.inputs.push_back({exponent > 0 ? "scaled_2^498" : "scaled_2^-498",
                             "coordinates whose powers leave the range of doubles",
                             {{{-0.7 * scale, 0.4 * scale}, {1.1 * scale, 1.3 * scale}}},
                             {0, 0},
                             up});
  }
  family.inputs.push_back({"translated",
                           "1e6 times its size away from the origin",
                           {{{1e6 - 0.7, 3e5 + 0.4}, {1e6 + 1.1, 3e5 + 1.3}}},
                           {1e6, 3e5},
                           up});
  return family;
}

}  // namespace irradiff
