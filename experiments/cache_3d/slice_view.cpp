#include "experiments/cache_3d/slice_view.h"

#include "derivatives/boundary/irradiance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace irradiff {

namespace {

/// Heights and distances below this share of a face's reach are rounding.
constexpr double kRounding = 1e-12;
/// What lies within this share of an inverse distance is at the same distance.
constexpr double kSameDistance = 1e-9;
/// Azimuths closer than this are one.
constexpr double kSameAzimuth = 1e-10;
/// An edge whose azimuths span less than this runs along the normal.
constexpr double kSteep = 1e-9;

double reach(const std::vector<Eigen::Vector3d>& vertices) {
  double largest = 0.0;
  for (const Eigen::Vector3d& vertex : vertices) largest = std::max(largest, vertex.norm());
  return largest;
}

double azimuthOf(const Eigen::Vector3d& direction) {
  const double azimuth = std::atan2(direction.y(), direction.x());
  return azimuth < 0.0 ? azimuth + 2.0 * std::numbers::pi : azimuth;
}

/// A place where an edge passes before another as seen from the receiver.
struct Crossing {
  Eigen::Vector3d direction;  ///< unit
  double nearer;              ///< inverse distances
  double farther;
};

std::optional<Crossing> crossingOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& normal,
                                   const Eigen::Vector3d& c, const Eigen::Vector3d& d,
                                   const Eigen::Vector3d& other_normal) {
  const double of_a = a.dot(other_normal);
  const double of_b = b.dot(other_normal);
  if ((of_a < 0.0) == (of_b < 0.0)) return std::nullopt;
  const double of_c = c.dot(normal);
  const double of_d = d.dot(normal);
  if ((of_c < 0.0) == (of_d < 0.0)) return std::nullopt;
  const Eigen::Vector3d first = a + of_a / (of_a - of_b) * (b - a);
  const Eigen::Vector3d second = c + of_c / (of_c - of_d) * (d - c);
  if (!(first.dot(second) > 0.0) || !(first.z() > 0.0)) return std::nullopt;
  // Of a list, by value: of two arguments std::minmax keeps references, here to what is gone.
  const auto [farther, nearer] = std::minmax({1.0 / first.norm(), 1.0 / second.norm()});
  if (nearer - farther <= kSameDistance * nearer) return std::nullopt;
  return Crossing{first.normalized(), nearer, farther};
}

}  // namespace

SceneOutline::SceneOutline(std::span<const Polygon> polygons) {
  std::map<std::array<double, 3>, std::size_t> numbers;
  std::map<std::pair<std::size_t, std::size_t>, bool> known;
  for (const Polygon& polygon : polygons) {
    std::vector<std::size_t> corners;
    for (const Eigen::Vector3d& v : polygon.vertices) {
      const auto [place, is_new] = numbers.try_emplace({v.x(), v.y(), v.z()}, vertices.size());
      if (is_new) vertices.push_back(v);
      corners.push_back(place->second);
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::pair<std::size_t, std::size_t> edge = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
      if (known.try_emplace(edge, true).second) edges.push_back({edge.first, edge.second});
    }
  }
}

SampleFrame sampleFrame(const Receiver& receiver) {
  const Eigen::Matrix<double, 3, 2> tangents = tangentFrame<double>(receiver.normal);
  return {receiver.position, tangents.col(0), tangents.col(1), receiver.normal};
}

SliceView::SliceView(std::span<const Polygon> polygons, const SurfaceRadiance& radiance, const Receiver& receiver)
    : frame_(sampleFrame(receiver)) {
  const Eigen::Matrix3d to_frame = frame_.axes().transpose();
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    Face face;
    double highest = 0.0;
    for (const Eigen::Vector3d& vertex : polygons[i].vertices) {
      face.vertices.emplace_back(to_frame * (vertex - receiver.position));
      highest = std::max(highest, face.vertices.back().z());
    }
    if (highest <= kRounding * reach(face.vertices)) continue;
    face.radiance = radiance.view(i, frame_);
    if (face.radiance.grid == nullptr) continue;
    const Eigen::Vector3d normal = to_frame * radiance.normal(i);
    face.inverse_plane = normal / normal.dot(face.vertices[0]);
    faces_.push_back(std::move(face));
  }
}

SliceEnd SliceView::endOf(const EdgePoint& point, const Eigen::Vector2d& along) {
  // Seen from a receiver that has moved by dx the edge has moved by -dx, and the half-plane meets it elsewhere:
  // dp = -dx + e (m.dx)/(m.e), m the half-plane's normal.
  const auto& [p, edge] = point;
  const Eigen::Vector2d across(-along[1], along[0]);
  const double square = p.squaredNorm();
  const double slope = 1.0 / across.dot(edge.head<2>());
  const Eigen::Vector2d motion_s = along.dot(edge.head<2>()) * slope * across - along;
  const Eigen::Vector2d motion_h = edge.z() * slope * across;
  return {p[0] * p[0] / square, 2.0 * p[0] * p[1] / (square * square) * (p[1] * motion_s - p[0] * motion_h)};
}

void SliceView::addSegment(std::size_t face, const EdgePoint& one, const EdgePoint& other, const Eigen::Vector2d& along,
                           std::vector<SliceSegment>& segments) const {
  Eigen::Vector2d p = one.place;
  Eigen::Vector2d q = other.place;
  if (std::max(p[0], q[0]) <= 0.0 || std::max(p[1], q[1]) <= 0.0) return;
  // Where the quarter plane ends a segment, direction and end stay.
  SliceEnd first = p.minCoeff() < 0.0 ? SliceEnd{} : endOf(one, along);
  SliceEnd last = q.minCoeff() < 0.0 ? SliceEnd{} : endOf(other, along);
  for (int axis = 0; axis < 2; ++axis) {
    if (p[axis] < 0.0) p += p[axis] / (p[axis] - q[axis]) * (q - p);
    if (q[axis] < 0.0) q += q[axis] / (q[axis] - p[axis]) * (p - q);
  }
  p = p.cwiseMax(0.0);
  q = q.cwiseMax(0.0);
  first.u = p[0] * p[0] / p.squaredNorm();
  last.u = q[0] * q[0] / q.squaredNorm();
  if (first.u > last.u) std::swap(first, last);
  if (!(last.u - first.u > kShortestPart)) return;
  const Eigen::Vector3d& plane = faces_[face].inverse_plane;
  segments.push_back({face, {along.dot(plane.head<2>()), plane.z()}, plane.head<2>(), first, last});
}

void SliceView::cut(double azimuth, std::vector<SliceSegment>& segments) const {
  segments.clear();
  const Eigen::Vector2d along(std::cos(azimuth), std::sin(azimuth));
  thread_local std::vector<EdgePoint> crossings;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const std::vector<Eigen::Vector3d>& vertices = faces_[f].vertices;
    const auto side = [&along](const Eigen::Vector3d& v) { return along[0] * v.y() - along[1] * v.x(); };
    crossings.clear();
    double before = side(vertices.back());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const double here = side(vertices[i]);
      if ((before < 0.0) != (here < 0.0)) {
        const Eigen::Vector3d& previous = vertices[i == 0 ? vertices.size() - 1 : i - 1];
        const Eigen::Vector3d edge = vertices[i] - previous;
        const Eigen::Vector3d p = previous + before / (before - here) * edge;
        crossings.push_back({{along.dot(p.head<2>()), p.z()}, edge});
      }
      before = here;
    }
    if (crossings.size() > 2) {
      const Eigen::Vector2d line = crossings[1].place - crossings[0].place;
      std::ranges::sort(crossings, {}, [&line](const EdgePoint& p) { return line.dot(p.place); });
    }
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      addSegment(f, crossings[i], crossings[i + 1], along, segments);
    }
  }
}

bool SliceView::isHidden(const Eigen::Vector3d& w, double limit, double spared) const {
  thread_local std::vector<SliceSegment> segments;
  cut(azimuthOf(w), segments);
  const double u = 1.0 - w.z() * w.z();
  const Eigen::Vector2d direction(std::hypot(w.x(), w.y()), w.z());
  return std::ranges::any_of(segments, [&](const SliceSegment& segment) {
    if (segment.begin.u > u - kSameDistance || segment.end.u < u + kSameDistance) return false;
    const double inverse = segment.inverse.dot(direction);
    return inverse > limit * (1.0 + kSameDistance) && std::abs(inverse - spared) > kSameDistance * spared;
  });
}

std::vector<SliceView::SteepEdge> SliceView::steepEdges(const SceneOutline& outline) const {
  const Eigen::Matrix3d to_frame = frame_.axes().transpose();
  std::vector<SteepEdge> steep;
  for (const auto& [i, j] : outline.edges) {
    const Eigen::Vector3d a = to_frame * (outline.vertices[i] - frame_.position);
    const Eigen::Vector3d b = to_frame * (outline.vertices[j] - frame_.position);
    const double distance = a.head<2>().norm();
    if (std::max(a.z(), b.z()) <= kRounding * reach({a, b})) continue;
    if ((b - a).head<2>().norm() > kSteep * distance) continue;
    steep.push_back({azimuthOf(a), distance});
  }
  return steep;
}

std::vector<double> SliceView::breaks(const SceneOutline& outline) const {
  const Eigen::Matrix3d to_frame = frame_.axes().transpose();
  std::vector<Eigen::Vector3d> vertices;
  for (const Eigen::Vector3d& vertex : outline.vertices) vertices.emplace_back(to_frame * (vertex - frame_.position));
  std::vector<double> azimuths;
  for (const Eigen::Vector3d& vertex : vertices) {
    const double distance = vertex.norm();
    if (vertex.z() < -kRounding * distance) continue;
    if (!isHidden(vertex / distance, 1.0 / distance, 0.0)) azimuths.push_back(azimuthOf(vertex));
  }
  std::vector<Eigen::Vector3d> normals;
  for (const auto& [i, j] : outline.edges) normals.emplace_back(vertices[i].cross(vertices[j]));
  for (std::size_t e = 0; e < outline.edges.size(); ++e) {
    const Eigen::Vector3d& a = vertices[outline.edges[e][0]];
    const Eigen::Vector3d& b = vertices[outline.edges[e][1]];
    if ((a.z() < 0.0) != (b.z() < 0.0)) azimuths.push_back(azimuthOf(a + a.z() / (a.z() - b.z()) * (b - a)));
    if (std::max(a.z(), b.z()) <= 0.0) continue;
    for (std::size_t f = 0; f < e; ++f) {
      const Eigen::Vector3d& c = vertices[outline.edges[f][0]];
      const Eigen::Vector3d& d = vertices[outline.edges[f][1]];
      const std::optional<Crossing> crossing = crossingOf(a, b, normals[e], c, d, normals[f]);
      if (!crossing || isHidden(crossing->direction, crossing->farther, crossing->nearer)) continue;
      azimuths.push_back(azimuthOf(crossing->direction));
    }
  }
  for (const SteepEdge& edge : steepEdges(outline)) azimuths.push_back(edge.azimuth);
  std::ranges::sort(azimuths);
  const auto same = [](double one, double next) { return next - one < kSameAzimuth; };
  azimuths.erase(std::unique(azimuths.begin(), azimuths.end(), same), azimuths.end());
  return azimuths;
}

}  // namespace irradiff
