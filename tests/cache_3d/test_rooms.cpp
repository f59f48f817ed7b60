#include "tests/cache_3d/test_rooms.h"

#include "experiments/cache_3d/direct_light.h"

namespace irradiff {

namespace {

using Vertices = std::vector<Eigen::Vector3d>;

/// The faces of a box: bottom, top, then the sides.
std::vector<Polygon> box(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double radiance) {
  const auto corner = [&](int x, int y, int z) {
    return Eigen::Vector3d(x > 0 ? high.x() : low.x(), y > 0 ? high.y() : low.y(), z > 0 ? high.z() : low.z());
  };
  const std::vector<Vertices> faces{{corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0)},
                                    {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)},
                                    {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)},
                                    {corner(0, 1, 0), corner(1, 1, 0), corner(1, 1, 1), corner(0, 1, 1)},
                                    {corner(0, 0, 0), corner(0, 1, 0), corner(0, 1, 1), corner(0, 0, 1)},
                                    {corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)}};
  std::vector<Polygon> polygons;
  for (const Vertices& face : faces) polygons.push_back({"face " + std::to_string(polygons.size()), face, radiance});
  return polygons;
}

}  // namespace

Room dataRoom(const std::string& name) { return readRoom(std::string(IRRADIFF_ROOM_FOLDER) + "/" + name + ".json"); }

const SurfaceRadiance& lightOfCornellBox() {
  static const SurfaceRadiance table = DirectLight(dataRoom("cornell_box")).tabulated(2);
  return table;
}

Room cornerRoom() {
  Room room;
  room.name = "corner";
  room.polygons = {{"floor", {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 0.0},
                   {"wall", {{0, 2, 0}, {2, 2, 0}, {2, 2, 1.5}, {0, 2, 1.5}}, 0.0},
                   {"lamp", {{0.6, 0.7, 1.4}, {1.1, 0.7, 1.4}, {1.1, 1.3, 1.4}, {0.6, 1.3, 1.4}}, 5.0}};
  room.reflectances = {0.5, 0.75, 0.0};
  room.camera = {{1.03, -3.0, 1.2}, {1.03, 1.0, 0.6}, {0, 0, 1}, 35.0};
  return room;
}

std::vector<Polygon> furnace(double radiance) {
  std::vector<Polygon> polygons = box({0, 0, 0}, {2, 2, 2}, radiance);
  for (const Polygon& face : box({0.7, 0.9, 0}, {1.1, 1.6, 0.8}, radiance)) {
    if (face.name != "face 0") polygons.push_back(face);
  }
  return polygons;
}

std::vector<SeenPoint> somePoints(const Room& room, std::size_t count) {
  const std::vector<SeenPoint> seen = seenPoints(room, 48);
  std::vector<SeenPoint> points;
  for (std::size_t k = 0; k < count; ++k) points.push_back(seen[(k * seen.size() + seen.size() / 2) / count]);
  return points;
}

Eigen::Vector3d tangential(const Eigen::Vector3d& v, const Eigen::Vector3d& normal) {
  return v - v.dot(normal) * normal;
}

}  // namespace irradiff
