#include "verification/closed_forms/closed_forms.h"

#include "verification/closed_forms/catalogue_entry.h"
#include "verification/closed_forms/closed_form_formulas.h"

#include <array>
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
using Scene = std::pair<Vertices, Receiver>;

// At the origin.
Receiver facingUp() { return {Vector3d(0, 0, 0), Vector3d(0, 0, 1)}; }
Receiver facingSideways() { return {Vector3d(0, 0, 0), Vector3d(1, 0, 0)}; }

// The rectangle [x0, x1] x [y0, y1] at height h, clockwise seen from below.
Vertices rectangleAbove(double x0, double x1, double y0, double y1, double h) {
  return {{x0, y0, h}, {x1, y0, h}, {x1, y1, h}, {x0, y1, h}};
}

// The standing geometry of Hamilton and Morgan: the plane of the polygon meets that of the element in the y axis, the
// element lies at (c, 0, 0) with normal +z. The polygon reaches from the y axis by (p, q) at y = 0 and by `ratio` times
// that at y = b.
Scene risingFromYAxis(double p, double q, double b, double c, double ratio) {
  return {Vertices{{0, 0, 0}, {p, 0, q}, {p * ratio, b, q * ratio}, {0, b, 0}},
          Receiver{Vector3d(c, 0, 0), Vector3d(0, 0, 1)}};
}

// A strip along y through (x0, z0) and (x1, z1), clockwise seen from below.
Vertices stripThrough(double x0, double z0, double x1, double z1, double distance) {
  const double half = stripHalfLength(distance);
  return {{x0, -half, z0}, {x1, -half, z1}, {x1, half, z1}, {x0, half, z0}};
}

// Normal with the first two components given. Rounded here, once, and used as it is by formula and configuration alike.
std::array<double, 3> normalFrom(double u, double v) { return {u, v, std::sqrt(1.0 - (u * u + v * v))}; }

Vertices regularPolygon(double sides, double circumradius, double h) {
  const int count = static_cast<int>(sides);
  Vertices vertices;
  for (int i = 0; i < count; ++i) {
    const HundredDigits angle = HundredDigits(2 * i) * piAs<HundredDigits>() / count;
    vertices.emplace_back(HundredDigits(circumradius * cos(angle)).convert_to<double>(),
                          HundredDigits(circumradius * sin(angle)).convert_to<double>(), h);
  }
  return vertices;
}

// Each coordinate of a vertex is off by at most 2^-53 r, so the polygon lies between the exact ones scaled by 1 +-
// delta with delta = sqrt(2) 2^-53 r / inradius <= sqrt(2) 2^-52, and F grows at most as the square of the scale.
constexpr double kRegularPolygonError = 0x1p-50;

std::vector<ClosedForm> rectangles() {
  return {
      makeEntry<Receiver>(
          "B-3", "parallel rectangle, normal through a corner", "Howell B-3; Modest D-10; Siegel and Howell",
          {{"a", 0.0625, 16}, {"b", 0.0625, 16}, {"c", 0.0625, 16}},
          [](Digits d) { return parallelRectangleAtCorner(d[0], d[1], d[2]); },
          [](Values v) {
            return Scene{rectangleAbove(0, v[0], 0, v[1], v[2]), facingUp()};
          }),
      makeEntry<Receiver>(
          "B-4", "perpendicular rectangle, corner at the foot of the element", "Howell B-4; Modest D-11",
          {{"a", 0.0625, 16}, {"b", 0.0625, 16}, {"c", 0.0625, 16}},
          [](Digits d) { return perpendicularRectangleAtCorner(d[0], d[1], d[2]); },
          [](Values v) {
            return Scene{rectangleAbove(0, v[0], 0, v[1], v[2]), facingSideways()};
          }),
      makeEntry<Receiver>(
          "B-3", "parallel rectangle, element anywhere", "Howell B-3 by configuration factor algebra",
          {{"x0", -4, 4}, {"y0", -4, 4}, {"width", 0.125, 8}, {"height", 0.125, 8}, {"h", 0.125, 8}},
          [](Digits d) { return parallelRectangle<HundredDigits>(d[0], d[0] + d[2], d[1], d[1] + d[3], d[4]); },
          [](Values v) {
            return Scene{rectangleAbove(v[0], v[0] + v[2], v[1], v[1] + v[3], v[4]), facingUp()};
          }),
      makeEntry<Receiver>(
          "B-4", "perpendicular rectangle, element anywhere", "Howell B-4 by configuration factor algebra",
          {{"x0", 0, 4}, {"y0", -4, 4}, {"width", 0.125, 8}, {"height", 0.125, 8}, {"h", 0.125, 8}},
          [](Digits d) { return perpendicularRectangle<HundredDigits>(d[0], d[0] + d[2], d[1], d[1] + d[3], d[4]); },
          [](Values v) {
            return Scene{rectangleAbove(v[0], v[0] + v[2], v[1], v[1] + v[3], v[4]), facingSideways()};
          }),
      makeEntry<Receiver>(
          "B-3", "rectangle, element and normal anywhere (u, v: first components of the normal)",
          "Howell B-3 and B-4 by configuration factor algebra; F is linear in the normal",
          {{"x0", -1, 1},
           {"y0", -1, 1},
           {"width", 0.125, 1},
           {"height", 0.125, 1},
           {"h", 1, 4},
           {"u", -0.1875, 0.1875},
           {"v", -0.1875, 0.1875}},
          [](Digits d) {
            const auto vector = rectangleVectorFormFactor<HundredDigits>(d[0], d[0] + d[2], d[1], d[1] + d[3], d[4]);
            const auto n = normalFrom(d[5].convert_to<double>(), d[6].convert_to<double>());
            return HundredDigits(n[0] * vector[0] + n[1] * vector[1] + n[2] * vector[2]);
          },
          [](Values v) {
            const auto n = normalFrom(v[5], v[6]);
            return Scene{rectangleAbove(v[0], v[0] + v[2], v[1], v[1] + v[3], v[4]),
                         Receiver{Vector3d(0, 0, 0), Vector3d(n[0], n[1], n[2])}};
          }),
      makeEntry<Receiver>(
          "B-8", "rectangle rising at an angle from the element's plane, by (p, q)",
          "Howell B-8; Hamilton and Morgan 1952", {{"p", -4, 4}, {"q", 0.125, 4}, {"b", 0.125, 4}, {"c", 0.125, 4}},
          [](Digits d) { return tiltedRectangle(d[0], d[1], d[2], d[3]); },
          [](Values v) { return risingFromYAxis(v[0], v[1], v[2], v[3], 1.0); }),
      makeEntry<Receiver>(
          "B-6", "rectangle rising by (p, q) with a right triangle added, so that the far end rises by ratio (p, q)",
          "Howell B-6; Hamilton and Morgan 1952",
          {{"p", -4, 4}, {"q", 0.125, 4}, {"b", 0.125, 4}, {"c", 0.125, 4}, {"ratio", 0.125, 4}},
          [](Digits d) {
            const HundredDigits a = sqrt(d[0] * d[0] + d[1] * d[1]);
            const HundredDigits tan_theta = (d[4] - 1) * a / d[2];
            return tiltedRectangleWithTriangle(d[0], d[1], d[2], d[3], tan_theta);
          },
          [](Values v) { return risingFromYAxis(v[0], v[1], v[2], v[3], v[4]); }),
  };
}

std::vector<ClosedForm> trianglesAndRegularPolygons() {
  return {
      makeEntry<Receiver>(
          "", "parallel right triangle, normal through an acute vertex", "half of Howell B-3; docs/closed_forms.md",
          {{"a", 0.0625, 16}, {"b", 0.0625, 16}, {"c", 0.0625, 16}},
          [](Digits d) { return parallelTriangleAtVertex(d[0], d[0], d[1], d[2]); },
          [](Values v) {
            return Scene{Vertices{{0, 0, v[2]}, {v[0], 0, v[2]}, {v[0], v[1], v[2]}}, facingUp()};
          }),
      makeEntry<Receiver>(
          "", "parallel triangle (0,0), (a,0), (p,q), normal through its first vertex", "docs/closed_forms.md",
          {{"a", 0.125, 8}, {"p", -8, 8}, {"q", 0.125, 8}, {"h", 0.125, 8}},
          [](Digits d) { return parallelTriangleAtVertex(d[0], d[1], d[2], d[3]); },
          [](Values v) {
            return Scene{Vertices{{0, 0, v[3]}, {v[0], 0, v[3]}, {v[1], v[2], v[3]}}, facingUp()};
          }),
      makeEntry<Receiver>(
          "", "perpendicular right triangle standing on the element's plane", "docs/closed_forms.md",
          {{"a", 0.0625, 16}, {"b", 0.0625, 16}, {"c", 0.0625, 16}},
          [](Digits d) { return standingRightTriangle(d[0], d[1], d[2]); },
          [](Values v) {
            return Scene{Vertices{{0, 0, 0}, {0, 0, v[0]}, {0, v[1], 0}},
                         Receiver{Vector3d(v[2], 0, 0), Vector3d(0, 0, 1)}};
          }),
      makeEntry<Receiver>(
          "", "parallel regular polygon of circumradius r, normal through its centre", "docs/closed_forms.md",
          {{"sides", 3, 64, true}, {"r", 0.125, 8}, {"h", 0.125, 8}},
          [](Digits d) { return regularPolygonOnAxis(d[0], d[1], d[2]); },
          [](Values v) {
            return Scene{regularPolygon(v[0], v[1], v[2]), facingUp()};
          },
          kRegularPolygonError),
  };
}

std::vector<ClosedForm> strips() {
  return {
      makeEntry<Receiver>(
          "B-71", "strip without end through (x0, z0) and (x1, z1)", "Howell B-71; Modest D-24",
          {{"x0", -4, 0.5}, {"z0", 1, 4}, {"x1", 3, 6}, {"z1", 0, 4}},
          [](Digits d) { return infiniteStrip(d[0], d[1], d[2], d[3]); },
          [](Values v) {
            return Scene{stripThrough(v[0], v[1], v[2], v[3], 8), facingUp()};
          },
          kStripError),
      makeEntry<Receiver>(
          "", "strip without end rising by (p, q) from a line in the element's plane", "Modest D-23",
          {{"p", -4, 4}, {"q", 0.125, 4}, {"c", 0.125, 4}},
          [](Digits d) { return infiniteTiltedStrip(d[0], d[1], d[2]); },
          [](Values v) {
            return Scene{stripThrough(0, 0, v[0], v[1], 16), Receiver{Vector3d(v[2], 0, 0), Vector3d(0, 0, 1)}};
          },
          kStripError),
  };
}

}  // namespace

std::span<const ClosedForm> closedForms() {
  static const std::vector<ClosedForm> entries = [] {
    std::vector<ClosedForm> all = rectangles();
    for (const auto& group : {trianglesAndRegularPolygons(), strips()})
      all.insert(all.end(), group.begin(), group.end());
    return all;
  }();
  return entries;
}

}  // namespace irradiff
