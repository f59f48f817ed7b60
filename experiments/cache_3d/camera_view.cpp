#include "experiments/cache_3d/camera_view.h"

#include "derivatives/boundary/irradiance.h"
#include "derivatives/scene/polygon.h"
#include "experiments/cache_3d/face_rays.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace irradiff {

namespace {

/// Planes through all vertices of one polygon to this share of the largest coordinate are those of another.
constexpr double kSamePlane = 1e-12;

struct Plane {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
};

Plane planeOf(const Polygon& polygon) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < polygon.vertices.size(); ++i) {
    sum += (polygon.vertices[i] - polygon.vertices[0]).cross(polygon.vertices[i + 1] - polygon.vertices[0]);
  }
  return {polygon.vertices[0], sum.normalized()};
}

bool isIn(const Plane& plane, const Polygon& polygon) {
  double largest = 0.0;
  double distance = 0.0;
  for (const Eigen::Vector3d& vertex : polygon.vertices) {
    largest = std::max(largest, vertex.lpNorm<Eigen::Infinity>());
    distance = std::max(distance, std::abs(plane.normal.dot(vertex - plane.point)));
  }
  return distance <= kSamePlane * largest;
}

}  // namespace

CameraProjection::CameraProjection(const Camera& camera, std::size_t width, std::size_t height)
    : position_(camera.position),
      forward_((camera.target - camera.position).normalized()),
      pixel_(2.0 * std::tan(camera.field_of_view * std::numbers::pi / 360.0) / static_cast<double>(height)),
      middle_column_(0.5 * static_cast<double>(width) - 0.5),
      middle_row_(0.5 * static_cast<double>(height) - 0.5) {
  right_ = forward_.cross(camera.up).normalized();
  up_ = right_.cross(forward_);
}

Eigen::Vector3d CameraProjection::direction(double column, double row) const {
  return forward_ + pixel_ * ((column - middle_column_) * right_ - (row - middle_row_) * up_);
}

std::optional<Eigen::Vector2d> CameraProjection::place(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d offset = point - position_;
  const double depth = offset.dot(forward_);
  if (!(depth > 0.0)) return std::nullopt;
  return Eigen::Vector2d(middle_column_ + offset.dot(right_) / (depth * pixel_),
                         middle_row_ - offset.dot(up_) / (depth * pixel_));
}

double CameraProjection::pixelSize(const Eigen::Vector3d& point) const {
  return pixel_ * (point - position_).dot(forward_);
}

std::vector<SeenPoint> seenPoints(const Room& room, std::size_t width) {
  const CameraProjection camera(room.camera, width, width);
  std::vector<Plane> planes;
  std::vector<std::size_t> first_in_plane;
  for (std::size_t i = 0; i < room.polygons.size(); ++i) {
    planes.push_back(planeOf(room.polygons[i]));
    std::size_t first = 0;
    while (first < i && !isIn(planes[first], room.polygons[i])) ++first;
    first_in_plane.push_back(first);
  }
  SampleFrame frame;
  frame.position = camera.position();
  frame.normal = camera.forward();
  frame.tangent = camera.right();
  frame.bitangent = frame.normal.cross(frame.tangent);
  const FaceRays faces(room.polygons);
  const ReceiverRays rays = faces.from(frame);
  std::vector<SeenPoint> seen;
  for (std::size_t pixel = 0; pixel < width * width; ++pixel) {
    const std::size_t row = pixel / width;
    const Eigen::Vector3d direction =
        camera.direction(static_cast<double>(pixel % width), static_cast<double>(row)).normalized();
    const RayHit hit = rays.cast(frame.axes().transpose() * direction);
    const std::optional<std::size_t> face = FaceRays::faceOf(hit.radiance);
    if (!face || room.polygons[*face].radiance > 0.0) continue;
    const Plane& plane = planes[*face];
    SeenPoint& point = seen.emplace_back();
    point.pixel = pixel;
    point.polygon = *face;
    point.plane = first_in_plane[*face];
    point.receiver.position = camera.position() + direction / hit.inverse_distance;
    point.receiver.position -= plane.normal.dot(point.receiver.position - plane.point) * plane.normal;
    point.receiver.normal = plane.normal.dot(direction) < 0.0 ? plane.normal : Eigen::Vector3d(-plane.normal);
    point.pixel_size = camera.pixelSize(point.receiver.position);
  }
  return seen;
}

}  // namespace irradiff
