#include "experiments/io/face_triangulation.h"

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/orientation.h"
#include "derivatives/scene/polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiff {

namespace {

using Triangle = std::array<std::size_t, 3>;

// The vertices scaled by a power of two so that the largest coordinate is in [1/2, 1), where orientations are exact;
// what is too small for that becomes 0.
std::vector<Eigen::Vector3d> scaledVertices(std::span<const Eigen::Vector3d> vertices) {
  constexpr double kNegligible = 0x1p-480;
  double largest = 0;
  for (const Eigen::Vector3d& vertex : vertices) largest = std::max(largest, vertex.lpNorm<Eigen::Infinity>());
  int exponent = 0;
  std::frexp(largest, &exponent);
  std::vector<Eigen::Vector3d> scaled(vertices.begin(), vertices.end());
  for (Eigen::Vector3d& vertex : scaled) {
    for (double& coordinate : vertex) {
      coordinate = std::ldexp(coordinate, -exponent);
      if (std::abs(coordinate) < kNegligible) coordinate = 0;
    }
  }
  return scaled;
}

// Newell's normal: the sum of the areas projected along each axis.
Eigen::Vector3d newellNormal(const std::vector<Eigen::Vector3d>& vertices) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d& next = vertices[i + 1 == vertices.size() ? 0 : i + 1];
    normal += (vertices[i] - vertices[0]).cross(next - vertices[0]);
  }
  return normal;
}

class EarClipping {
 public:
  // Requires that the polygon in the plane is simple. Lengths are those of `vertices` in space.
  EarClipping(std::vector<Eigen::Vector2d> plane, const std::vector<Eigen::Vector3d>& vertices)
      : plane_(std::move(plane)),
        vertices_(vertices),
        previous_(plane_.size()),
        next_(plane_.size()),
        is_convex_(plane_.size()),
        diagonal_(plane_.size(), kNoEar) {
    for (std::size_t i = 0; i < plane_.size(); ++i) {
      next_[i] = i + 1 == plane_.size() ? 0 : i + 1;
      previous_[next_[i]] = i;
    }
  }

  std::optional<std::vector<Triangle>> triangles() {
    winding_ = windingNumber();
    for (std::size_t i = 0; i < plane_.size(); ++i) is_convex_[i] = isConvex(i);
    for (std::size_t i = 0; i < plane_.size(); ++i) diagonal_[i] = diagonalOfEar(i);
    std::vector<Triangle> triangles;
    for (std::size_t left = plane_.size(); left > 3; --left) {
      const auto ear = std::ranges::min_element(diagonal_);
      if (*ear == kNoEar) return std::nullopt;
      triangles.push_back(clip(static_cast<std::size_t>(ear - diagonal_.begin())));
    }
    triangles.push_back(inFaceOrder(static_cast<std::size_t>(
        std::ranges::find_if(diagonal_, [](double length) { return length != kClipped; }) - diagonal_.begin())));
    return triangles;
  }

 private:
  static constexpr double kNoEar = std::numeric_limits<double>::max();
  static constexpr double kClipped = std::numeric_limits<double>::infinity();

  int side(std::size_t a, std::size_t b, std::size_t c) const { return orientation(plane_[a], plane_[b], plane_[c]); }

  // +1 for counterclockwise, -1 for clockwise: the lowest of the leftmost vertices is convex.
  int windingNumber() const {
    const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
    };
    const auto lowest = static_cast<std::size_t>(std::ranges::min_element(plane_, before) - plane_.begin());
    return side(previous_[lowest], lowest, next_[lowest]);
  }

  bool isConvex(std::size_t i) const { return winding_ * side(previous_[i], i, next_[i]) > 0; }

  // Squared length of the diagonal that cuts the ear at vertex i off, kNoEar where there is none.
  double diagonalOfEar(std::size_t i) const {
    if (!is_convex_[i]) return kNoEar;
    const std::size_t a = previous_[i];
    const std::size_t b = next_[i];
    for (std::size_t k = next_[b]; k != a; k = next_[k]) {
      // Where the boundary enters the ear, a vertex that is not convex is the first in it.
      if (!is_convex_[k] && winding_ * side(a, i, k) >= 0 && winding_ * side(i, b, k) >= 0 &&
          winding_ * side(b, a, k) >= 0) {
        return kNoEar;
      }
    }
    return (vertices_[a] - vertices_[b]).squaredNorm();
  }

  Triangle inFaceOrder(std::size_t i) const {
    Triangle triangle{previous_[i], i, next_[i]};
    std::ranges::sort(triangle);
    return triangle;
  }

  Triangle clip(std::size_t i) {
    const std::size_t a = previous_[i];
    const std::size_t b = next_[i];
    const Triangle triangle = inFaceOrder(i);
    next_[a] = b;
    previous_[b] = a;
    diagonal_[i] = kClipped;
    // Convexity first: an ear is judged by that of the other one.
    for (const std::size_t neighbour : {a, b}) is_convex_[neighbour] = isConvex(neighbour);
    for (const std::size_t neighbour : {a, b}) diagonal_[neighbour] = diagonalOfEar(neighbour);
    return triangle;
  }

  std::vector<Eigen::Vector2d> plane_;
  const std::vector<Eigen::Vector3d>& vertices_;
  int winding_ = 0;
  // Of the vertices that are left.
  std::vector<std::size_t> previous_;
  std::vector<std::size_t> next_;
  std::vector<bool> is_convex_;
  std::vector<double> diagonal_;  // of the ear at each vertex
};

// In the plane, by the rule of scenes.
bool isSimple(const std::vector<Eigen::Vector2d>& plane) {
  Polygon polygon;
  for (const Eigen::Vector2d& vertex : plane) polygon.vertices.emplace_back(vertex.x(), vertex.y(), 0);
  try {
    validate(polygon, 0);
  } catch (const InvalidScene&) {
    return false;
  }
  return true;
}

}  // namespace

std::optional<std::vector<Triangle>> triangulation(std::span<const Eigen::Vector3d> vertices) {
  if (vertices.size() > kMaxSplitVertices) return std::nullopt;
  const std::vector<Eigen::Vector3d> scaled = scaledVertices(vertices);
  const Eigen::Vector3d normal = newellNormal(scaled);
  std::array<Eigen::Index, 3> axes{0, 1, 2};
  std::ranges::stable_sort(
      axes, [&normal](Eigen::Index a, Eigen::Index b) { return std::abs(normal[a]) > std::abs(normal[b]); });
  for (const Eigen::Index axis : axes) {
    std::vector<Eigen::Vector2d> plane;
    plane.reserve(scaled.size());
    for (const Eigen::Vector3d& vertex : scaled) plane.emplace_back(vertex[(axis + 1) % 3], vertex[(axis + 2) % 3]);
    if (!isSimple(plane)) continue;
    if (auto triangles = EarClipping(std::move(plane), scaled).triangles()) return triangles;
  }
  return std::nullopt;
}

}  // namespace irradiff
