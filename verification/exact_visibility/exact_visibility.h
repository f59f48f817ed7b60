#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace irradiff {

/// What a receiver sees of a scene of polygons, in rational arithmetic: no rounding, no epsilon. An oracle for floating
/// point visibility; it shares nothing with it but the scene's plain data (docs/exact_visibility.md).
///
/// Seen from the receiver x, the front-most polygon changes only along straight lines of the scene: edges of polygons
/// and creases, where two polygons intersect each other. The pieces along which it does change are the visible arcs.

/// A rational number in lowest terms, in decimal digits; the denominator is positive. `approximation` is within an ulp.
struct ExactRational {
  std::string numerator;
  std::string denominator;
  double approximation = 0.0;

  /// By the exact value; the approximation follows from it.
  bool operator==(const ExactRational& other) const {
    return numerator == other.numerator && denominator == other.denominator;
  }
};

using ExactVector = std::array<ExactRational, 3>;

/// A straight line piece of the scene. Orders edges before creases, then by polygon, then by edge or partner.
struct ExactLine {
  enum class Kind {
    kEdge,    ///< from vertex `edge_or_partner` of the polygon to the next one
    kCrease,  ///< common to the interiors of `polygon` and `edge_or_partner`, polygon < edge_or_partner
  };
  Kind kind = Kind::kEdge;
  std::size_t polygon = 0;
  std::size_t edge_or_partner = 0;

  bool operator==(const ExactLine&) const = default;
  bool operator<(const ExactLine& other) const {
    return std::tie(kind, polygon, edge_or_partner) < std::tie(other.kind, other.polygon, other.edge_or_partner);
  }
};

/// Index of the front-most polygon; nothing for the background.
using FrontPolygon = std::optional<std::size_t>;

/// Why an arc ends.
enum class ExactLimitKind {
  kEndpoint,  ///< its line piece ends, above the horizon
  kHorizon,   ///< its line reaches the horizon n.(p-x) = 0, with or without ending there
  kCrossing,  ///< other lines cross it as seen from the receiver
};

struct ExactArcLimit {
  ExactLimitKind kind = ExactLimitKind::kEndpoint;
  /// On an edge p = v_i + t (v_{i+1} - v_i); nothing on a crease.
  std::optional<ExactRational> t;
  /// The point on the arc's own line, metres.
  ExactVector point;
  /// Of a crossing: the other exposed lines there, one for each straight line, the nearest to the receiver first. Of an
  /// end point: those at another depth, as a rule none.
  std::vector<ExactLine> crossing;
};

/// A maximal piece of one line with the same front-most polygon along each side, and another one on the other side.
/// Right is the side to which (v_i - x) x (v_{i+1} - v_i) points; creases run along the cross product of the area
/// vectors (sum of v_i x v_{i+1}) of their two polygons, the lower index first.
struct ExactArc {
  /// Where several lines lie on each other in space, the lowest of them: any edge before any crease.
  ExactLine line;
  ExactArcLimit begin;
  ExactArcLimit end;
  FrontPolygon left;
  FrontPolygon right;
  /// Exposed lines that coincide with the arc as seen from the receiver, at another depth: E has no gradient here. The
  /// arc's own line is then the nearest at the middle of such a piece.
  std::vector<ExactLine> aligned;
};

/// A direction in which exposed lines cross at different depths. Exposed is what is not hidden in every direction
/// around this one.
struct ExactApparentVertex {
  /// From the receiver, of length 1 along n.
  ExactVector direction;
  /// One for each straight line, the nearest to the receiver first.
  std::vector<ExactLine> lines;
  /// More than two lines meet, as where a scene vertex is seen on a foreign line: as a rule E has no Hessian here.
  bool degenerate = false;
};

/// The polygon that is front-most just above the horizon, from azimuth `begin` counterclockwise about n to `end`.
struct ExactHorizonArc {
  ExactVector begin;  ///< direction in the receiver's plane, of any length
  ExactVector end;
  std::size_t polygon = 0;
};

struct ExactVisibility {
  std::vector<ExactArc> arcs;  ///< in the order of their lines, and along each line
  std::vector<ExactApparentVertex> apparent_vertices;
  std::vector<ExactHorizonArc> horizon;
  /// Polygons whose plane contains the receiver: they have no image, so they neither radiate to it nor block.
  std::vector<std::size_t> edge_on;
};

/// What the receiver sees strictly above its horizon n.(p-x) > 0. Polygons radiate and block on both sides and may
/// intersect each other; the background is whatever no polygon covers. Of coplanar polygons of equal radiance that
/// overlap, the lowest index is front-most.
///
/// Throws InvalidScene naming polygon or receiver, value and rule: for what `validate` refuses, for a vertex that is
/// not exactly in its polygon's plane, and for overlapping coplanar polygons of different radiance that are both
/// front-most somewhere. Time: at least quadratic in the number of polygons.
ExactVisibility exactVisibility(const std::vector<Polygon>& polygons, const Receiver& receiver);

}  // namespace irradiff
