#include "derivatives/visibility/view_overlap.h"

#include "derivatives/boundary/horizon_clip.h"
#include "derivatives/flatland/segment_form.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace irradiff {
namespace {

/// Relative error of a direction or a plane normal computed in double, with room to spare.
constexpr double kDirectionError = 16.0 * 0x1p-53;
/// Coordinates of neighbouring polygons differ by the rounding of a rotation and a translation: a few units in the last
/// place.
constexpr double kCoordinateError = 4.0 * 0x1p-53;

double largestCoordinate(const Polygon& polygon, const Receiver& receiver) {
  double largest = receiver.position.cwiseAbs().maxCoeff();
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
  }
  return largest;
}

Eigen::Vector3d scaledBy(const Eigen::Vector3d& v, int exponent) {
  return {std::ldexp(v(0), exponent), std::ldexp(v(1), exponent), std::ldexp(v(2), exponent)};
}

/// The polygon projected along the largest component of its normal, scaled into the unit square.
std::vector<Eigen::Vector2d> flatten(const Polygon& polygon) {
  double extent = 0.0;
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    extent = std::max(extent, (vertex - polygon.vertices[0]).cwiseAbs().maxCoeff());
  }
  const int exponent = -std::ilogb(extent);
  std::vector<Eigen::Vector3d> local;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    local.push_back(scaledBy(vertex - polygon.vertices[0], exponent));
    normal += local.size() > 1 ? local[local.size() - 2].cross(local.back()).eval() : Eigen::Vector3d::Zero().eval();
  }
  Eigen::Index drop = 0;
  normal.cwiseAbs().maxCoeff(&drop);
  const bool flip = normal(drop) < 0.0;
  std::vector<Eigen::Vector2d> flat;
  for (const Eigen::Vector3d& p : local) {
    const double u = p((drop + 1) % 3);
    const double v = p((drop + 2) % 3);
    flat.emplace_back(flip ? v : u, flip ? u : v);
  }
  return flat;
}

/// The largest coordinate in units of the polygon's extent, at least 1.
double relativeCoordinate(const Polygon& polygon) {
  double extent = 0.0;
  double largest = 0.0;
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    extent = std::max(extent, (vertex - polygon.vertices[0]).cwiseAbs().maxCoeff());
    largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
  }
  return std::max(largest / extent, 1.0);
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return cross<double>(Vector2<double>(b - a), Vector2<double>(c - a));
}

/// Whether vertex k of the ring can be cut off: no other vertex is in its triangle or within `clearance` (twice an
/// area) of the cut. A vertex that rounding puts on the far side of a cut would leave a ring that crosses itself.
bool isEar(const std::vector<Eigen::Vector2d>& p, const std::vector<std::size_t>& ring, std::size_t k,
           double clearance) {
  const std::size_t n = ring.size();
  const Eigen::Vector2d& a = p[ring[(k + n - 1) % n]];
  const Eigen::Vector2d& b = p[ring[k]];
  const Eigen::Vector2d& c = p[ring[(k + 1) % n]];
  if (turn(a, b, c) <= 0.0) {
    return false;
  }
  for (std::size_t i = 0; i + 3 < n; ++i) {
    const Eigen::Vector2d& q = p[ring[(k + 2 + i) % n]];
    if (turn(a, b, q) >= 0.0 && turn(b, c, q) >= 0.0 && turn(c, a, q) >= -clearance) {
      return false;
    }
  }
  return true;
}

/// Whether the piece has an edge that rounding leaves a direction. Two that have none are points to each other: so are
/// the splinters of two walls whose common corner stands on the horizon.
bool isResolved(const std::vector<PolygonView::Direction>& piece) {
  for (std::size_t i = 0; i < piece.size(); ++i) {
    if (piece[i].unit.cross(piece[(i + 1) % piece.size()].unit).norm() > kDirectionError) {
      return true;
    }
  }
  return false;
}

/// On which sides of the plane through the receiver and the edge from p to q a piece lies, up to rounding; both where
/// it lies in that plane.
struct Sides {
  bool left = true;
  bool right = true;
};

Sides sidesOf(const std::vector<PolygonView::Direction>& piece, const PolygonView::Direction& p,
              const PolygonView::Direction& q) {
  // With differences of directions, so that a short edge loses nothing more to rounding than what the ends are off.
  const Eigen::Vector3d moment = p.unit.cross(q.unit - p.unit);
  const double sine = moment.norm();
  Sides sides;
  for (const PolygonView::Direction& direction : piece) {
    // The plane is as uncertain as the ends, and turns about one end by what the other is off: more the farther away.
    const double turn_about_q = (direction.unit - q.unit).norm() * (kDirectionError + p.uncertainty) / sine;
    const double turn_about_p = (direction.unit - p.unit).norm() * (kDirectionError + q.uncertainty) / sine;
    const double tolerance = kDirectionError + direction.uncertainty + turn_about_p + turn_about_q;
    const double offset = moment.dot(direction.unit - p.unit) / sine;
    sides.left = sides.left && offset >= -tolerance;
    sides.right = sides.right && offset <= tolerance;
  }
  return sides;
}

/// Whether a piece that lies in the plane through the receiver with this unit normal, up to rounding, surrounds the
/// receiver: its directions leave no half plane free. So does a sheet that the receiver all but touches, and it hides
/// the half space behind.
bool surroundsReceiver(const std::vector<PolygonView::Direction>& piece, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d axis = normal.cross(piece.front().unit);
  std::vector<double> turns;
  double uncertainty = kDirectionError;
  for (const PolygonView::Direction& direction : piece) {
    turns.push_back(std::atan2(direction.unit.dot(axis), direction.unit.dot(piece.front().unit)));
    uncertainty = std::max(uncertainty, direction.uncertainty);
  }
  std::sort(turns.begin(), turns.end());
  double gap = turns.front() + 2.0 * std::numbers::pi - turns.back();
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    gap = std::max(gap, turns[i + 1] - turns[i]);
  }
  return gap <= std::numbers::pi + 2.0 * uncertainty;
}

/// Whether an edge passes the receiver so closely that rounding may turn the plane through both by kLargestTurn
/// (radians): such a plane tells no sides.
bool touchesReceiver(const PolygonView::Direction& p, const PolygonView::Direction& q) {
  constexpr double kLargestTurn = 0.01;
  return p.unit.dot(q.unit) < 0.0 &&
         kDirectionError + std::max(p.uncertainty, q.uncertainty) > kLargestTurn * p.unit.cross(q.unit - p.unit).norm();
}

/// Whether the plane through one edge of `a` has all of `a` on one side and all of `b` on the other.
bool separates(const std::vector<PolygonView::Direction>& a, const std::vector<PolygonView::Direction>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const PolygonView::Direction& p = a[i];
    const PolygonView::Direction& q = a[(i + 1) % a.size()];
    if (p.unit.cross(q.unit).norm() <= kDirectionError || touchesReceiver(p, q)) {
      continue;
    }
    const Sides own = sidesOf(a, p, q);
    if (own.left && own.right && surroundsReceiver(a, p.unit.cross(q.unit - p.unit).normalized())) {
      continue;
    }
    const Sides other = sidesOf(b, p, q);
    if ((own.left && other.right) || (own.right && other.left)) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulate(const Polygon& polygon) {
  const std::vector<Eigen::Vector2d> flat = flatten(polygon);
  std::vector<std::size_t> ring(flat.size());
  std::iota(ring.begin(), ring.end(), std::size_t{0});
  std::vector<std::array<std::size_t, 3>> triangles;
  const double clearance = kDirectionError * relativeCoordinate(polygon);
  std::size_t k = 0;
  std::size_t rejected = 0;
  while (ring.size() > 3) {
    const std::size_t n = ring.size();
    // Where rounding leaves no clear ear any ear will do, and where it leaves none, what is left is as thin as the
    // rounding and any triangle will do.
    if (rejected >= 2 * n || isEar(flat, ring, k % n, rejected < n ? clearance : 0.0)) {
      triangles.push_back({ring[(k + n - 1) % n], ring[k % n], ring[(k + 1) % n]});
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(k % n));
      rejected = 0;
    } else {
      ++k;
      ++rejected;
    }
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

PolygonView viewOf(const Polygon& polygon, std::span<const std::array<std::size_t, 3>> triangles,
                   const Receiver& receiver) {
  const double largest = largestCoordinate(polygon, receiver);
  const int exponent = largest > 0.0 ? -std::ilogb(largest) : 0;
  const double coordinate = std::ldexp(largest, exponent);
  const Vector3<double> position = scaledBy(receiver.position, exponent);
  PolygonView view;
  for (const std::array<std::size_t, 3>& triangle : triangles) {
    std::array<Vector3<double>, 3> corners;
    std::transform(triangle.begin(), triangle.end(), corners.begin(),
                   [&](std::size_t i) { return scaledBy(polygon.vertices[i], exponent); });
    const ClippedPolygon<double> clipped =
        clipAtHorizon<double>(std::span<const Vector3<double>>(corners), position, receiver.normal);
    std::vector<PolygonView::Direction> piece;
    for (const ClippedVertex<double>& vertex : clipped.vertices) {
      const Vector3<double> r = narrow<double>(vertex.position);
      const double distance = r.stableNorm();
      piece.push_back({r / distance, kCoordinateError * coordinate / distance});
    }
    if (!piece.empty()) {
      view.pieces.push_back(std::move(piece));
    }
  }
  return view;
}

bool overlap(const PolygonView& a, const PolygonView& b) {
  return std::any_of(a.pieces.begin(), a.pieces.end(), [&b](const auto& piece) {
    return std::any_of(b.pieces.begin(), b.pieces.end(), [&piece](const auto& other) {
      return (isResolved(piece) || isResolved(other)) && !separates(piece, other) && !separates(other, piece);
    });
  });
}

}  // namespace irradiff
