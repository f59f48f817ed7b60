#include "verification/exact_visibility/exact_rays.h"

#include "verification/checks/random.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace irradiff {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

class ExactRayCaster {
 public:
  ExactRayCaster(const std::vector<Polygon>& polygons, const Receiver& receiver) : origin_(point(receiver.position)) {
    for (std::size_t owner = 0; owner < polygons.size(); ++owner) {
      const Polygon& polygon = polygons[owner];
      for (std::size_t i = 1; i + 1 < polygon.vertices.size(); ++i) {
        const Kernel::Triangle_3 triangle(point(polygon.vertices[0]), point(polygon.vertices[i]),
                                          point(polygon.vertices[i + 1]));
        if (CGAL::coplanar(triangle[0], triangle[1], triangle[2], origin_)) continue;
        triangles_.push_back(triangle);
        owners_.push_back(owner);
      }
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }

  /// Index of the polygon and squared distance.
  using Nearest = std::pair<std::size_t, Kernel::FT>;

  std::optional<Nearest> nearestHit(const Eigen::Vector3d& direction) const {
    const Kernel::Ray_3 ray(origin_, Kernel::Vector_3(direction.x(), direction.y(), direction.z()));
    std::vector<Tree::Intersection_and_primitive_id<Kernel::Ray_3>::Type> hits;
    tree_.all_intersections(ray, std::back_inserter(hits));

    std::map<std::size_t, Hit> hit_polygons;
    for (const auto& [intersection, triangle] : hits) {
      Hit& hit = hit_polygons[owners_[static_cast<std::size_t>(triangle - triangles_.begin())]];
      hit.is_inside = !hit.is_inside;
      hit.squared_distance = CGAL::squared_distance(origin_, boost::get<Kernel::Point_3>(intersection));
    }
    std::optional<Nearest> nearest;
    for (const auto& [polygon, hit] : hit_polygons) {
      if (hit.is_inside && (!nearest || hit.squared_distance < nearest->second)) {
        nearest = {polygon, hit.squared_distance};
      }
    }
    return nearest;
  }

 private:
  struct Hit {
    bool is_inside = false;
    Kernel::FT squared_distance;
  };

  static Kernel::Point_3 point(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

  Kernel::Point_3 origin_;
  Triangles triangles_;
  std::vector<std::size_t> owners_;  // index of each triangle's polygon
  Tree tree_;
};

void requireValid(const std::vector<Polygon>& polygons, const Receiver& receiver) {
  validate(receiver, 0);
  for (std::size_t i = 0; i < polygons.size(); ++i) validate(polygons[i], i);
}

}  // namespace

RayCastIrradiance castExactRays(const std::vector<Polygon>& polygons, const Receiver& receiver, std::uint64_t seed,
                                std::size_t rays) {
  requireValid(polygons, receiver);
  const ExactRayCaster caster(polygons, receiver);
  const Eigen::Vector3d tangent = receiver.normal.unitOrthogonal();
  const Eigen::Vector3d bitangent = receiver.normal.cross(tangent);

  double mean = 0.0;
  double squares = 0.0;  // sum of squared deviations from the mean (Welford)
  for (std::size_t ray = 0; ray < rays; ++ray) {
    KeyedRandom random(seed, "exact rays", ray);
    const double squared_sine = random.unit();
    const double azimuth = random.between(0.0, 2.0 * std::numbers::pi);
    const double sine = std::sqrt(squared_sine);
    const Eigen::Vector3d direction = sine * std::cos(azimuth) * tangent + sine * std::sin(azimuth) * bitangent +
                                      std::sqrt(1.0 - squared_sine) * receiver.normal;
    const auto hit = caster.nearestHit(direction);
    const double radiance = hit ? polygons[hit->first].radiance : 0.0;
    const double deviation = radiance - mean;
    mean += deviation / static_cast<double>(ray + 1);
    squares += deviation * (radiance - mean);
  }
  const double count = static_cast<double>(rays);
  return {std::numbers::pi * mean, std::numbers::pi * std::sqrt(squares / (count - 1.0) / count)};
}

std::vector<std::optional<ExactHit>> exactHits(const std::vector<Polygon>& polygons, const Receiver& receiver,
                                               std::span<const Eigen::Vector3d> directions) {
  requireValid(polygons, receiver);
  const ExactRayCaster caster(polygons, receiver);
  std::vector<std::optional<ExactHit>> hits;
  hits.reserve(directions.size());
  for (const Eigen::Vector3d& direction : directions) {
    std::optional<ExactHit>& hit = hits.emplace_back();
    const auto nearest = caster.nearestHit(direction);
    if (nearest) hit = {nearest->first, std::sqrt(CGAL::to_double(CGAL::exact(nearest->second)))};
  }
  return hits;
}

}  // namespace irradiff
