#include "verification/closed_forms/catalogue_entry.h"
#include "verification/closed_forms/closed_form_formulas_between_areas.h"
#include "verification/closed_forms/closed_forms.h"

#include <cmath>

namespace irradiff {
namespace {

using closed_forms::kStripError;
using closed_forms::makeEntry;
using closed_forms::stripHalfLength;
using Eigen::Vector3d;
using Digits = std::span<const HundredDigits>;
using Values = std::span<const double>;
using Vertices = std::vector<Vector3d>;
using Scene = std::pair<Vertices, ReceivingParallelogram>;

// A1 is [x0, x0 + width] x [y0, y0 + height] in the plane z = 0, facing +z.
ReceivingParallelogram floorArea(double x0, double width, double y0, double height, bool smooth = true) {
  return {Vector3d(x0, y0, 0), Vector3d(width, 0, 0), Vector3d(0, height, 0), Vector3d(0, 0, 1), smooth};
}

// A2 in the plane z = h, clockwise seen from below.
Vertices ceiling(double x0, double x1, double y0, double y1, double h) {
  return {{x0, y0, h}, {x1, y0, h}, {x1, y1, h}, {x0, y1, h}};
}

// A2 reaching from (x0, z0) to (x1, z1) for y in [y0, y1]; clockwise seen from larger x.
Vertices wall(double x0, double z0, double x1, double z1, double y0, double y1) {
  return {{x0, y0, z0}, {x1, y0, z1}, {x1, y1, z1}, {x0, y1, z0}};
}

std::vector<ClosedFormBetweenAreas> rectangles() {
  return {
      makeEntry<ReceivingParallelogram>(
          "C-11", "equal parallel rectangles, directly opposed", "Howell C-11; Modest D-38",
          {{"a", 0.125, 8}, {"b", 0.125, 8}, {"c", 0.25, 8}},
          [](Digits d) { return opposedRectangles(d[0], d[1], d[2]); },
          [](Values v) {
            return Scene{ceiling(0, v[0], 0, v[1], v[2]), floorArea(0, v[0], 0, v[1])};
          }),
      makeEntry<ReceivingParallelogram>(
          "C-13", "parallel rectangles anywhere", "Howell C-13; Ehlert and Smith 1993",
          {{"x", -2, 2},
           {"width1", 0.125, 4},
           {"y", -2, 2},
           {"height1", 0.125, 4},
           {"xi", -2, 2},
           {"width2", 0.125, 4},
           {"eta", -2, 2},
           {"height2", 0.125, 4},
           {"z", 0.25, 4}},
          [](Digits d) {
            return parallelRectangles<HundredDigits>(d[0], d[0] + d[1], d[2], d[2] + d[3], d[4], d[4] + d[5], d[6],
                                                     d[6] + d[7], d[8]);
          },
          [](Values v) {
            return Scene{ceiling(v[4], v[4] + v[5], v[6], v[6] + v[7], v[8]), floorArea(v[0], v[1], v[2], v[3])};
          }),
      makeEntry<ReceivingParallelogram>(
          "C-9b", "rectangles in perpendicular planes, apart from the line where these meet",
          "Ehlert and Smith 1993; the perpendicular case of Howell C-9a and C-9b",
          {{"x", 0.25, 2},
           {"width1", 0.125, 4},
           {"y", -2, 2},
           {"height1", 0.125, 4},
           {"xi", 0, 2},
           {"height2", 0.125, 4},
           {"eta", -2, 2},
           {"width2", 0.125, 4}},
          [](Digits d) {
            return perpendicularRectangles<HundredDigits>(d[0], d[0] + d[1], d[2], d[2] + d[3], d[4], d[4] + d[5], d[6],
                                                          d[6] + d[7]);
          },
          [](Values v) {
            return Scene{wall(0, v[4], 0, v[4] + v[5], v[6], v[6] + v[7]), floorArea(v[0], v[1], v[2], v[3])};
          }),
      makeEntry<ReceivingParallelogram>(
          "C-14", "perpendicular rectangles with a common edge l", "Howell C-14; Modest D-39",
          {{"h", 0.125, 8}, {"l", 0.125, 8}, {"w", 0.125, 8}},
          [](Digits d) { return perpendicularRectanglesWithCommonEdge(d[0], d[1], d[2]); },
          [](Values v) {
            return Scene{wall(0, 0, 0, v[0], 0, v[1]), floorArea(0, v[2], 0, v[1], false)};
          }),
  };
}

// A1 is cut to the length 1 about y = 0, which changes nothing: along an endless plate the form factor is constant.
std::vector<ClosedFormBetweenAreas> infinitePlates() {
  return {
      makeEntry<ReceivingParallelogram>(
          "C-1", "opposed plates without end, both w wide", "Howell C-1; Modest D-32",
          {{"w", 0.125, 8}, {"h", 0.25, 8}}, [](Digits d) { return opposedInfinitePlates(d[0], d[1]); },
          [](Values v) {
            const double half = stripHalfLength(v[0] + v[1]);
            return Scene{ceiling(0, v[0], -half, half, v[1]), floorArea(0, v[0], -0.5, 1)};
          },
          kStripError),
      makeEntry<ReceivingParallelogram>(
          "C-5a", "plates without end with a common edge, the second rising by (p, q)", "Howell C-5a; Hottel 1954",
          {{"a", 0.125, 4}, {"p", -4, 4}, {"q", 0.25, 4}},
          [](Digits d) { return infinitePlatesWithCommonEdge(d[0], d[1], d[2]); },
          [](Values v) {
            const double half = stripHalfLength(v[0] + std::abs(v[1]) + v[2]);
            return Scene{wall(0, 0, v[1], v[2], -half, half), floorArea(0, v[0], -0.5, 1)};
          },
          kStripError),
      makeEntry<ReceivingParallelogram>(
          "", "perpendicular plates without end with a common edge", "Modest D-33", {{"h", 0.125, 8}, {"w", 0.125, 8}},
          [](Digits d) { return perpendicularInfinitePlates(d[0], d[1]); },
          [](Values v) {
            const double half = stripHalfLength(v[0] + v[1]);
            return Scene{wall(0, 0, 0, v[0], -half, half), floorArea(0, v[1], -0.5, 1)};
          },
          kStripError),
  };
}

}  // namespace

std::span<const ClosedFormBetweenAreas> closedFormsBetweenAreas() {
  static const std::vector<ClosedFormBetweenAreas> entries = [] {
    std::vector<ClosedFormBetweenAreas> all = rectangles();
    for (const auto& entry : infinitePlates()) all.push_back(entry);
    return all;
  }();
  return entries;
}

}  // namespace irradiff
