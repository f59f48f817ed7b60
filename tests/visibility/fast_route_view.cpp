#include "tests/visibility/rational_view.h"

#include <cmath>
#include <stdexcept>

namespace irradiff {

namespace {

// Points and places of a mesh in metres relative to the receiver, from the coordinates.
class MeshGeometry {
 public:
  MeshGeometry(const SceneMesh& mesh, const Receiver& receiver)
      : mesh_(mesh), position_(rational(receiver.position)), normal_(rational(receiver.normal)) {}

  RationalVector vertex(std::size_t index) const {
    const int exponent = mesh_.exponent();
    return rational(mesh_.vertices()[index].unaryExpr([exponent](double c) { return std::ldexp(c, exponent); })) -
           position_;
  }

  // A vertex, or where the line through two vertices meets the plane of a face.
  RationalVector point(std::size_t index) const {
    const MeshPoint& p = mesh_.points()[index];
    RationalVector start = vertex(p.start);
    if (p.face == kNone) return start;
    const RationalVector along = vertex(p.end) - start;
    const Plane plane = planeOf(p.face);
    return start + dot(plane.area, plane.origin - start) / dot(plane.area, along) * along;
  }

  RationalVector start(std::size_t edge) const { return point(mesh_.edges()[edge].start); }
  RationalVector end(std::size_t edge) const { return point(mesh_.edges()[edge].end); }
  RationalVector planeOfView(std::size_t edge) const { return cross(start(edge), end(edge)); }

  RationalVector place(std::size_t edge, const EdgePlace& place) const {
    const RationalVector r = start(edge);
    const RationalVector e = end(edge) - r;
    return r + parameter(r, e, place) * e;
  }

  bool contains(std::size_t face) const {
    const Plane plane = planeOf(face);
    return dot(plane.area, plane.origin) == 0;
  }

 private:
  struct Plane {
    RationalVector area;
    RationalVector origin;
  };

  Plane planeOf(std::size_t face) const {
    const auto& [a, b, c] = mesh_.faces()[face].plane;
    return {cross(vertex(b) - vertex(a), vertex(c) - vertex(a)), vertex(a)};
  }

  // t of the place on r + t e.
  Rational parameter(const RationalVector& r, const RationalVector& e, const EdgePlace& place) const {
    switch (place.kind) {
      case EdgePlace::Kind::kStart:
        return 0;
      case EdgePlace::Kind::kEnd:
        return 1;
      case EdgePlace::Kind::kHorizon:
        return -dot(normal_, r) / dot(normal_, e);
      case EdgePlace::Kind::kEdge: {
        const RationalVector plane = planeOfView(place.id);
        return -dot(plane, r) / dot(plane, e);
      }
      case EdgePlace::Kind::kPoint: {
        // (r + t e) x p = 0; all products are along r x e.
        const RationalVector p = point(place.id);
        const RationalVector side = cross(r, e);
        return -dot(cross(r, p), side) / dot(cross(e, p), side);
      }
      case EdgePlace::Kind::kInLine: {
        // r + t e on the line q + s f: (r - q) x f + t e x f = 0.
        const RationalVector q = start(place.id);
        const RationalVector f = end(place.id) - q;
        const RationalVector side = cross(e, f);
        return -dot(cross(r - q, f), side) / dot(side, side);
      }
    }
    throw std::logic_error("a kind of place that has no definition");
  }

  const SceneMesh& mesh_;
  RationalVector position_;
  RationalVector normal_;
};

}  // namespace

RationalView rationalView(const VisibleBoundary& seen, const SceneMesh& mesh, std::span<const Polygon> polygons,
                          const Receiver& receiver) {
  detail::ViewBuilder builder(polygons, receiver);
  RationalView& view = builder.view;
  const MeshGeometry geometry(mesh, receiver);
  for (const VisibleArc& arc : seen.arcs) {
    builder.addArc(geometry.place(arc.edge, arc.first), geometry.place(arc.edge, arc.last),
                   builder.sides(arc.sides.left, arc.sides.right));
  }
  for (std::size_t i = 0; i < seen.horizon.size(); ++i) {
    const HorizonPlace& here = seen.horizon[i];
    const HorizonPlace& next = seen.horizon[(i + 1) % seen.horizon.size()];
    builder.addHorizon(geometry.place(here.edge, here.place), geometry.place(next.edge, next.place),
                       here.counterclockwise);
  }
  builder.join();

  // The predicate that decides it, in the mesh's units.
  const ViewPredicates predicates(
      mesh, receiver.position.unaryExpr([&mesh](double c) { return std::ldexp(c, -mesh.exponent()); }),
      receiver.normal);
  for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
    if (predicates.receiverOffset(f) == 0) view.edge_on.insert(mesh.faces()[f].polygon);
  }
  for (const ApparentVertex& vertex : seen.apparent_vertices) {
    const RationalVector direction = geometry.place(vertex.farther, {EdgePlace::Kind::kEdge, vertex.nearer});
    const RationalVector plane = geometry.planeOfView(vertex.farther);
    const RationalVector far_circle = withoutScale(plane);
    const bool runs_along = leading(plane) > 0;
    const auto along = [&](const ArcSides& sides) {
      ArcSidesInView result = builder.sides(sides.left, sides.right);
      if (result.left == result.right) return ArcSidesInView{};
      if (!runs_along) std::swap(result.left, result.right);
      return result;
    };
    const ArcSidesInView before = along(runs_along ? vertex.before : vertex.after);
    const ArcSidesInView after = along(runs_along ? vertex.after : vertex.before);
    if (before == after) continue;
    view.vertices.insert({1 / dot(builder.normal(), direction) * direction, far_circle,
                          withoutScale(geometry.planeOfView(vertex.nearer)), before, after});
  }
  return view;
}

}  // namespace irradiff
