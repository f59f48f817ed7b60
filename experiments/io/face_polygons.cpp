#include "experiments/io/face_polygons.h"

#include "experiments/io/face_triangulation.h"
#include "experiments/io/scene_text.h"

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace irradiff {

namespace {

// The name for a scene file, short enough for one with `reserved` bytes to spare. The end says which face it is, so the
// beginning is cut.
std::string sceneName(const std::string& name, std::size_t reserved) {
  std::string utf8 = utf8Text(name);
  const std::size_t longest = kMaxNameBytes - reserved;
  if (utf8.size() <= longest) return utf8;
  constexpr std::string_view kCut = "...";
  std::size_t start = utf8.size() - (longest - kCut.size());
  const auto is_inside_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (is_inside_character(utf8[start])) ++start;
  return std::string(kCut) + utf8.substr(start);
}

class PolygonMaker {
 public:
  explicit PolygonMaker(const ObjModel& model) : model_(model) {}

  void add(const ObjFace& face) {
    constexpr std::size_t kTriangleNumber = 6;  // ".4094" and one to spare
    Polygon polygon{sceneName(face.name, kTriangleNumber), distinctVertices(face), face.radiance};
    if (polygon.vertices.size() < 3) {
      ++made_.dropped_faces;
      return;
    }
    try {
      addValid(polygon);
    } catch (const PolygonWithoutArea&) {
      ++made_.dropped_faces;
    } catch (const NonPlanarPolygon& error) {
      split(polygon, face, error.what());
    } catch (const InvalidScene& error) {
      refuseLine(model_.file, face.line, error.what());
    }
  }

  FacePolygons take() { return std::move(made_); }

 private:
  void addValid(const Polygon& polygon) {
    validate(polygon, made_.polygons.size());
    made_.polygons.push_back(polygon);
  }

  std::vector<Eigen::Vector3d> distinctVertices(const ObjFace& face) {
    std::vector<Eigen::Vector3d> vertices;
    for (const std::size_t index : face.vertices) {
      const Eigen::Vector3d& vertex = model_.vertices[index];
      if (vertices.empty() || vertex != vertices.back()) vertices.push_back(vertex);
    }
    while (vertices.size() > 1 && vertices.front() == vertices.back()) vertices.pop_back();
    made_.dropped_vertices += face.vertices.size() - vertices.size();
    return vertices;
  }

  void split(const Polygon& polygon, const ObjFace& face, const std::string& not_planar) {
    const auto triangles = triangulation(polygon.vertices);
    if (!triangles) {
      refuseLine(model_.file, face.line,
                 not_planar + "; and it cannot be split into triangles: must have at most " +
                     std::to_string(kMaxSplitVertices) + " vertices, and not meet itself seen along a coordinate axis");
    }
    ++made_.split_faces;
    for (const std::array<std::size_t, 3>& corners : *triangles) {
      Polygon triangle{polygon.name, {}, polygon.radiance};
      triangle.name += '.' + std::to_string(&corners - triangles->data() + 1);
      for (const std::size_t corner : corners) triangle.vertices.push_back(polygon.vertices[corner]);
      try {
        addValid(triangle);
        ++made_.triangles;
      } catch (const PolygonWithoutArea&) {
        // A face may have vertices on the line between their neighbours; to within rounding here.
        continue;
      }
    }
  }

  const ObjModel& model_;
  FacePolygons made_;
};

}  // namespace

FacePolygons facePolygons(const ObjModel& model) {
  PolygonMaker maker(model);
  for (const ObjFace& face : model.faces) maker.add(face);
  FacePolygons made = maker.take();
  if (made.polygons.empty()) {
    throw ObjFileError(model.file.string() + ": none of its " + std::to_string(model.faces.size()) +
                       " faces has an area, at least one must");
  }
  return made;
}

}  // namespace irradiff
