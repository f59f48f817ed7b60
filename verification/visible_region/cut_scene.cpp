#include "verification/visible_region/cut_scene.h"

#include "derivatives/scene/triangulation.h"

#include <optional>
#include <utility>

namespace irradiff {
namespace {

using Digits = Multiprecision;
using Vector = MultiprecisionVector;
/// A convex loop of points relative to the receiver.
using Loop = std::vector<Vector>;

Vector crossProduct(const Vector& a, const Vector& b) {
  return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

Digits dotProduct(const Vector& a, const Vector& b) { return a(0) * b(0) + a(1) * b(1) + a(2) * b(2); }

Digits sumOfMagnitudes(const Vector& a, const Vector& b) {
  return abs(a(0) * b(0)) + abs(a(1) * b(1)) + abs(a(2) * b(2));
}

/// The points p with normal.p >= offset.
struct HalfSpace {
  Vector normal;
  Digits offset;

  /// normal.p - offset, exactly 0 where nothing else is left than rounding.
  Digits value(const Vector& p) const {
    static const Digits kZero = ldexp(Digits(1), -500);
    const Digits value = dotProduct(normal, p) - offset;
    const Digits size = sumOfMagnitudes(normal, p) + abs(offset);
    return abs(value) <= kZero * size ? Digits(0) : value;
  }
};

/// A loop on both sides of a plane.
struct Parts {
  Loop inside;
  Loop outside;
};

Parts cut(const Loop& loop, const HalfSpace& half_space) {
  std::vector<Digits> values;
  bool any_inside = false;
  bool any_outside = false;
  for (const Vector& p : loop) {
    values.push_back(half_space.value(p));
    any_inside = any_inside || values.back() > 0;
    any_outside = any_outside || values.back() < 0;
  }
  if (!any_outside) return {loop, {}};
  if (!any_inside) return {{}, loop};
  Parts parts;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t next = (i + 1) % loop.size();
    if (values[i] >= 0) parts.inside.push_back(loop[i]);
    if (values[i] <= 0) parts.outside.push_back(loop[i]);
    if ((values[i] > 0 && values[next] < 0) || (values[i] < 0 && values[next] > 0)) {
      const Digits t = values[i] / (values[i] - values[next]);
      const Vector crossing = loop[i] + Vector((loop[next] - loop[i]) * t);
      parts.inside.push_back(crossing);
      parts.outside.push_back(crossing);
    }
  }
  return parts;
}

/// The directions in which a triangle is seen, and the points behind its plane.
struct Screen {
  std::array<HalfSpace, 3> cone;
  HalfSpace behind;
};

/// Nothing where the receiver is in the triangle's plane.
std::optional<Screen> screenOf(const Loop& triangle) {
  std::array<Vector, 3> sides;
  for (std::size_t i = 0; i < 3; ++i) sides[i] = crossProduct(triangle[i], triangle[(i + 1) % 3]);
  const HalfSpace first_side{sides[0], 0};
  const Digits volume = first_side.value(triangle[2]);
  if (volume == 0) return std::nullopt;
  const Digits turn = volume > 0 ? 1 : -1;
  // (q1 - q0) x (q2 - q0) = q0 x q1 + q1 x q2 + q2 x q0, and its product with each q is the volume.
  const Vector normal = sides[0] + sides[1] + sides[2];
  Screen screen{{}, {Vector(normal * turn), volume * turn}};
  for (std::size_t i = 0; i < 3; ++i) screen.cone[i] = {Vector(sides[i] * turn), 0};
  return screen;
}

/// What is not hidden of a loop is appended to `seen`. In the screen's own plane it hides if `hides_in_plane`.
void appendSeen(const Loop& loop, const Screen& screen, bool hides_in_plane, std::vector<Loop>& seen) {
  bool any_off_plane = false;
  for (const Vector& p : loop) any_off_plane = any_off_plane || screen.behind.value(p) != 0;
  std::vector<HalfSpace> hiding(screen.cone.begin(), screen.cone.end());
  if (any_off_plane) {
    hiding.push_back(screen.behind);
  } else if (!hides_in_plane) {
    seen.push_back(loop);
    return;
  }
  // Not to be cut in vain.
  for (const HalfSpace& half_space : hiding) {
    bool any_inside = false;
    for (const Vector& p : loop) any_inside = any_inside || half_space.value(p) > 0;
    if (!any_inside) {
      seen.push_back(loop);
      return;
    }
  }
  Loop rest = loop;
  for (const HalfSpace& half_space : hiding) {
    Parts parts = cut(rest, half_space);
    if (parts.outside.size() >= 3) seen.push_back(std::move(parts.outside));
    rest = std::move(parts.inside);
    if (rest.size() < 3) return;
  }
}

/// Lambert: half the sum of the arcs' angles along the normals of their planes. Points to the loop's side.
Vector vectorFormFactor(const Loop& loop, const Digits& turn) {
  Vector sum = Vector::Constant(0);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector& p = loop[i];
    const Vector& q = loop[(i + 1) % loop.size()];
    const Vector side = crossProduct(p, q);
    const Digits size = sqrt(dotProduct(side, side));
    if (size == 0) continue;
    sum += side * Digits(atan2(size, dotProduct(p, q)) / size);
  }
  return sum * Digits(turn / 2);
}

}  // namespace

CutScene::CutScene(std::span<const Polygon> polygons) {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    radiances_.emplace_back(polygons[i].radiance);
    const std::vector<MultiprecisionVector> vertices = withoutRounding(polygons[i].vertices);
    for (const std::array<std::size_t, 3>& t : triangulate(polygons[i])) {
      triangles_.push_back({{vertices[t[0]], vertices[t[1]], vertices[t[2]]}, i});
    }
  }
}

MultiprecisionVector CutScene::vectorIrradiance(const MultiprecisionVector& position,
                                                const MultiprecisionVector& normal) const {
  std::vector<Loop> loops;
  std::vector<std::optional<Screen>> screens;
  for (const Triangle& triangle : triangles_) {
    Loop& loop = loops.emplace_back();
    for (const Vector& vertex : triangle.vertices) loop.push_back(vertex - position);
    screens.push_back(screenOf(loop));
  }
  const HalfSpace horizon{normal, 0};
  Vector sum = Vector::Constant(0);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (!screens[i] || radiances_[triangles_[i].polygon] == 0) continue;
    const Digits turn = HalfSpace{crossProduct(loops[i][0], loops[i][1]), 0}.value(loops[i][2]) > 0 ? 1 : -1;
    std::vector<Loop> seen;
    if (Loop above = cut(loops[i], horizon).inside; above.size() >= 3) seen.push_back(std::move(above));
    for (std::size_t j = 0; j < loops.size() && !seen.empty(); ++j) {
      if (j == i || !screens[j]) continue;
      std::vector<Loop> still_seen;
      for (const Loop& loop : seen) appendSeen(loop, *screens[j], j < i, still_seen);
      seen = std::move(still_seen);
    }
    for (const Loop& loop : seen) sum += vectorFormFactor(loop, turn) * radiances_[triangles_[i].polygon];
  }
  return sum;
}

}  // namespace irradiff
