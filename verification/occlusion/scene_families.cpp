#include "verification/occlusion/scene_families.h"

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/scene_evaluation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

using Eigen::Vector3d;

const Vector3d kUp(0.0, 0.0, 1.0);

/// Two orthonormal vectors across `normal`.
std::array<Vector3d, 2> tangentsOf(const Vector3d& normal, KeyedRandom& random) {
  Vector3d across = normal.cross(random.direction());
  while (across.norm() < 1e-3) across = normal.cross(random.direction());
  across.normalize();
  return {across, normal.cross(across)};
}

/// A star-shaped polygon about `centre`: convex where `unevenness` is 0.
Polygon star(const std::string& name, const Vector3d& centre, const Vector3d& normal, double radius, double unevenness,
             std::size_t corners, double radiance, KeyedRandom& random) {
  const auto [u, v] = tangentsOf(normal, random);
  const double turn = random.between(0.0, 2.0 * std::numbers::pi);
  Polygon polygon{name, {}, radiance};
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = turn + 2.0 * std::numbers::pi * (static_cast<double>(i) + random.between(-0.2, 0.2)) /
                                    static_cast<double>(corners);
    const double r = radius * (1.0 - unevenness * (i % 2 == 0 ? 0.0 : random.between(0.3, 0.9)));
    polygon.vertices.push_back(centre + r * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return polygon;
}

Vector3d tiltedUp(double most, KeyedRandom& random) { return (kUp + most * random.direction()).normalized(); }

/// Mostly dark, sometimes shining.
double occluderRadiance(KeyedRandom& random) { return random.unit() < 0.7 ? 0.0 : random.between(0.1, 5.0); }

/// One to three emitters overhead, and screens at any depth in front.
OccludedScene screens(double tilt, double unevenness, KeyedRandom& random) {
  OccludedScene scene;
  scene.receiver = {{random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(-0.2, 0.2)}, kUp};
  const std::size_t emitters = 1 + random.below(3);
  for (std::size_t i = 0; i < emitters; ++i) {
    const Vector3d centre(random.between(-1.5, 1.5), random.between(-1.5, 1.5), random.between(1.5, 3.0));
    scene.polygons.push_back(star("emitter " + std::to_string(i), centre, tiltedUp(tilt, random),
                                  random.between(0.5, 1.5), unevenness, 3 + random.below(4), random.between(0.5, 10.0),
                                  random));
  }
  const std::size_t occluders = 1 + random.below(4);
  for (std::size_t i = 0; i < occluders; ++i) {
    const double depth = random.between(0.2, 0.95);
    const Vector3d behind(random.between(-1.5, 1.5), random.between(-1.5, 1.5), random.between(1.5, 3.0));
    scene.polygons.push_back(star("occluder " + std::to_string(i),
                                  scene.receiver.position + depth * (behind - scene.receiver.position),
                                  tiltedUp(tilt, random), depth * random.between(0.2, 0.9), unevenness,
                                  3 + random.below(4), occluderRadiance(random), random));
  }
  return scene;
}

OccludedScene flatScreens(KeyedRandom& random) { return screens(0.0, 0.0, random); }
OccludedScene tiltedScreens(KeyedRandom& random) { return screens(0.7, 0.0, random); }
OccludedScene unevenScreens(KeyedRandom& random) { return screens(0.4, 0.7, random); }

OccludedScene tiltedReceivers(KeyedRandom& random) {
  OccludedScene scene = screens(0.7, random.unit() < 0.5 ? 0.0 : 0.7, random);
  scene.receiver.normal = random.direction();
  return scene;
}

/// Polygons in any position about a common centre: they pass through each other and through the emitter.
OccludedScene piercing(KeyedRandom& random) {
  OccludedScene scene;
  scene.receiver = {{random.between(-0.5, 0.5), random.between(-0.5, 0.5), 0.0}, tiltedUp(0.8, random)};
  const std::size_t count = 2 + random.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d centre = Vector3d(0.0, 0.0, 2.0) + 0.4 * random.direction();
    scene.polygons.push_back(star("polygon " + std::to_string(i), centre, random.direction(), random.between(0.4, 1.2),
                                  random.unit() < 0.3 ? 0.6 : 0.0, 3 + random.below(4),
                                  i == 0 || random.unit() < 0.5 ? random.between(0.5, 5.0) : 0.0, random));
  }
  return scene;
}

/// The faces of a block: a mesh with shared edges.
void addBlock(const Vector3d& centre, const Eigen::Matrix3d& axes, const std::string& name, double radiance,
              KeyedRandom& random, std::vector<Polygon>& polygons) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Polygon face{name, {}, radiance > 0.0 ? radiance * random.between(0.5, 1.5) : 0.0};
      for (const auto& [u, v] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        Vector3d signs;
        signs(axis) = side;
        signs((axis + 1) % 3) = u;
        signs((axis + 2) % 3) = v;
        // One sum for a corner, so that its faces share it to the last bit.
        face.vertices.emplace_back(centre + signs(0) * axes.col(0) + signs(1) * axes.col(1) + signs(2) * axes.col(2));
      }
      polygons.push_back(std::move(face));
    }
  }
}

/// A room with one or two blocks in it, every face of its own radiance.
OccludedScene rooms(KeyedRandom& random) {
  OccludedScene scene;
  const Vector3d half(random.between(1.0, 2.0), random.between(1.0, 2.0), random.between(1.0, 2.0));
  addBlock(Vector3d::Zero(), half.asDiagonal(), "wall", random.between(0.5, 5.0), random, scene.polygons);
  const std::size_t blocks = 1 + random.below(2);
  for (std::size_t i = 0; i < blocks; ++i) {
    const Eigen::AngleAxisd turn(random.between(0.0, 1.5), random.unit() < 0.5 ? kUp : random.direction());
    const Vector3d size(random.between(0.1, 0.3), random.between(0.1, 0.3), random.between(0.1, 0.3));
    addBlock(half.cwiseProduct(0.6 * random.direction()), turn.toRotationMatrix() * size.asDiagonal(), "block",
             random.unit() < 0.5 ? 0.0 : 2.0, random, scene.polygons);
  }
  scene.receiver = {half.cwiseProduct(0.9 * random.direction()), random.direction()};
  return scene;
}

/// One of the others, moved away and scaled.
OccludedScene movedAndScaled(KeyedRandom& random) {
  const std::array draws = {flatScreens, tiltedReceivers, piercing};
  OccludedScene scene = draws[random.below(draws.size())](random);
  const double scale = random.decade(-3.0, 3.0);
  const Vector3d shift = random.decade(-1.0, 2.0) * random.direction();
  for (Polygon& polygon : scene.polygons) {
    for (Vector3d& v : polygon.vertices) v = scale * (v + shift);
  }
  scene.receiver.position = scale * (scene.receiver.position + shift);
  return scene;
}

/// A polygon with one edge through `point` along `along`.
Polygon withEdge(const std::string& name, const Vector3d& point, const Vector3d& along, double radiance,
                 KeyedRandom& random) {
  Vector3d across = random.direction();
  across = (across - across.dot(along) * along).normalized();
  const double before = random.between(0.2, 0.8);
  const double after = random.between(0.2, 0.8);
  const double depth = random.between(0.3, 1.0);
  return {name,
          {point - before * along, point + after * along, point + random.between(0.0, 0.5) * along + depth * across,
           point - random.between(0.0, 0.3) * along + depth * across},
          radiance};
}

/// Built so that from one place three edges cross in one direction, an edge passes a foreign vertex, two edges lie over
/// each other, or a polygon is seen edge-on; the receiver is 1e-2 to 1e-16 away from that place.
OccludedScene nearEvents(KeyedRandom& random) {
  OccludedScene scene;
  const Vector3d x(random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(-0.5, 0.5));
  scene.receiver = {x, tiltedUp(0.6, random)};
  const Vector3d w = (scene.receiver.normal + 0.8 * random.direction()).normalized();
  const auto across = [&] {
    const auto [u, v] = tangentsOf(w, random);
    return Vector3d((u + random.between(-0.5, 0.5) * w).normalized());
  };
  const Vector3d first = across();
  const double near = random.between(0.5, 1.5);
  const double middle = near + random.between(0.2, 1.0);
  const double far = middle + random.between(0.2, 1.0);
  scene.polygons.push_back(withEdge("far", x + far * w, across(), random.between(1.0, 5.0), random));
  scene.polygons.push_back(withEdge("near", x + near * w, first, occluderRadiance(random), random));
  switch (random.below(4)) {
    case 0:  // a third edge through the place where the two cross
      scene.polygons.push_back(withEdge("middle", x + middle * w, across(), occluderRadiance(random), random));
      break;
    case 1: {  // a vertex there
      Polygon middle_polygon = withEdge("middle", x + middle * w, across(), occluderRadiance(random), random);
      const Vector3d back = x + middle * w - middle_polygon.vertices[0];
      for (Vector3d& v : middle_polygon.vertices) v += back;
      scene.polygons.push_back(middle_polygon);
      break;
    }
    case 2: {  // an edge that crosses the nearest in view at a small angle, or lies over it
      const Vector3d in_plane = first + random.between(-0.3, 0.3) * w;
      const Vector3d along = (in_plane + random.decade(-16.0, -1.0) * random.direction()).normalized();
      scene.polygons.push_back(withEdge("middle", x + middle * w, along, occluderRadiance(random), random));
      break;
    }
    default: {  // a polygon that is seen edge-on
      const Vector3d along = across();
      const Vector3d c = x + middle * w;
      scene.polygons.push_back(
          {"edge-on", {c - 0.3 * along, c + 0.4 * along, c + 0.2 * along + 0.3 * w}, occluderRadiance(random)});
    }
  }
  scene.receiver.position = x + random.decade(-16.0, -2.0) * random.direction();
  return scene;
}

/// Screens of sizes and distances over six decades, all about one line of sight.
OccludedScene anySize(KeyedRandom& random) {
  OccludedScene scene;
  scene.receiver = {random.direction(), tiltedUp(0.8, random)};
  const Vector3d w = (scene.receiver.normal + 0.8 * random.direction()).normalized();
  const std::size_t count = 3 + random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = random.decade(-3.0, 3.0);
    const Vector3d centre = scene.receiver.position + distance * (w + 0.3 * random.direction());
    scene.polygons.push_back(star("polygon " + std::to_string(i), centre, random.direction(),
                                  distance * random.decade(-1.0, 1.0), random.unit() < 0.3 ? 0.6 : 0.0,
                                  3 + random.below(4), i == 0 || random.unit() < 0.4 ? random.decade(-2.0, 3.0) : 0.0,
                                  random));
  }
  return scene;
}

/// Tilted screens, and the receiver 1e-1 to 1e-12 from a vertex, an edge or the plane of a polygon.
OccludedScene closeBy(KeyedRandom& random) {
  OccludedScene scene = screens(0.7, random.unit() < 0.5 ? 0.0 : 0.7, random);
  const Polygon& polygon = scene.polygons[random.below(scene.polygons.size())];
  const std::vector<Vector3d>& v = polygon.vertices;
  const Vector3d along = v[1] - v[0];
  const Vector3d across = v[2] - v[0];
  const std::array<Vector3d, 3> places = {v[0], Vector3d(v[0] + random.unit() * along),
                                          Vector3d(v[0] + random.between(-0.5, 1.5) * along + random.unit() * across)};
  const Vector3d& place = places[random.below(places.size())];
  // Well off the plane for the distance: on a surface a receiver must face away from it.
  const Vector3d off_plane = (random.unit() < 0.5 ? 1.0 : -1.0) * along.cross(across).normalized();
  scene.receiver.position = place + random.decade(-12.0, -1.0) * (off_plane + 0.9 * random.direction()).normalized();
  scene.receiver.normal = random.direction();
  return scene;
}

bool isValid(const OccludedScene& scene) {
  try {
    for (std::size_t i = 0; i < scene.polygons.size(); ++i) validate(scene.polygons[i], i);
    validate(scene.receiver, 0);
    return true;
  } catch (const InvalidScene&) {
    return false;
  }
}

}  // namespace

const std::vector<SceneFamily>& sceneFamilies() {
  static const std::vector<SceneFamily> families = {
      {"screens", "level emitters of different radiance behind level screens at any depth", false, flatScreens},
      {"tilted screens", "emitters and screens tilted", false, tiltedScreens},
      {"uneven screens", "emitters and screens that are not convex", false, unevenScreens},
      {"tilted receivers", "screens that cross the receiver's horizon", false, tiltedReceivers},
      {"piercing", "polygons that pass through each other and through the emitter's plane", false, piercing},
      {"rooms", "a room with blocks: meshes with shared edges, each face of its own radiance", false, rooms},
      {"moved and scaled", "others translated by up to 100 and scaled by 1e-3 to 1e3", false, movedAndScaled},
      {"any size", "polygons whose sizes and distances go over six decades", false, anySize},
      {"close by", "receivers 1e-1 to 1e-12 from a vertex, an edge or the plane of a polygon", true, closeBy},
      {"near events", "receivers 1e-2 to 1e-16 from where edges, vertices or planes meet in view", true, nearEvents},
  };
  return families;
}

const SceneFamily& sceneFamily(std::string_view name) {
  const auto found = std::ranges::find(sceneFamilies(), name, &SceneFamily::name);
  if (found == sceneFamilies().end()) {
    throw std::invalid_argument("no family of scenes is called \"" + std::string(name) + '"');
  }
  return *found;
}

OccludedScene drawScene(const SceneFamily& family, std::uint64_t seed, std::uint64_t index) {
  KeyedRandom random(seed, family.name, index);
  OccludedScene scene = family.draw(random);
  while (!isValid(scene)) scene = family.draw(random);
  return scene;
}

bool isClearOfEvents(const OccludedScene& scene, double distance) {
  const SceneEvaluator evaluator(scene.polygons);
  const VisibleBoundary view = evaluator.view(scene.receiver);
  const double step = distance * extentOf(scene);
  for (int i = 0; i < 27; ++i) {
    const Vector3d direction = Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).cast<double>();
    if (direction.isZero()) continue;
    const Receiver beside{scene.receiver.position + step * direction.normalized(), scene.receiver.normal};
    if (!(evaluator.view(beside) == view)) return false;
  }
  return true;
}

}  // namespace irradiff
