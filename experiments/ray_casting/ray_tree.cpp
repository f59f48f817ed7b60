#include "experiments/ray_casting/ray_tree.h"

#include <algorithm>
#include <cmath>
#include <embree3/rtcore.h>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {

namespace {

/// By how much a box is wider than its face. A ray in single precision leaves that in double by up to
/// 2^-24 (|origin| + sqrt(3) r) in each coordinate at the distance r, which is at most 2 sqrt(3) here: 7 * 2^-24.
/// Boxes are rounded to single precision too.
constexpr double kBoxMargin = 16 * 0x1p-24;
static_assert(kLargestTreeCoordinate == 1.0, "kBoxMargin is for coordinates in [-1, 1]");

struct Box {
  Eigen::Vector3f lower;
  Eigen::Vector3f upper;
};

Box boxOf(const SceneFace& face) {
  const auto& [a, b, c] = face.vertices;
  const Eigen::Vector3d lower = a.cwiseMin(b).cwiseMin(c).array() - kBoxMargin;
  const Eigen::Vector3d upper = a.cwiseMax(b).cwiseMax(c).array() + kBoxMargin;
  return {lower.cast<float>(), upper.cast<float>()};
}

void tellBox(const RTCBoundsFunctionArguments* arguments) {
  const Box& box = static_cast<const Box*>(arguments->geometryUserPtr)[arguments->primID];
  arguments->bounds_o->lower_x = box.lower.x();
  arguments->bounds_o->lower_y = box.lower.y();
  arguments->bounds_o->lower_z = box.lower.z();
  arguments->bounds_o->upper_x = box.upper.x();
  arguments->bounds_o->upper_y = box.upper.y();
  arguments->bounds_o->upper_z = box.upper.z();
}

/// Embree's context comes first, and so leads to the rest.
struct Visit {
  RTCIntersectContext context;
  double* nearest;
  const std::function<bool(std::size_t)>* visit;
};

void visitFace(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const Visit& visit = *reinterpret_cast<const Visit*>(arguments->context);
  if (!(*visit.visit)(arguments->primID)) return;
  // What is farther need not be visited. Boxes are entered before their margin.
  auto* const hit = reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  hit->ray.tfar = std::min(hit->ray.tfar, static_cast<float>(1.0 / *visit.nearest + kBoxMargin));
  hit->hit.geomID = arguments->geomID;
  hit->hit.primID = arguments->primID;
}

}  // namespace

struct RayTree::Embree {
  explicit Embree(std::span<const SceneFace> faces) {
    for (const SceneFace& face : faces) boxes.push_back(boxOf(face));
    // One thread builds: callers have threads of their own.
    device = rtcNewDevice("threads=1");
    if (device == nullptr) fail();
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
    rtcSetGeometryUserData(geometry, boxes.data());
    rtcSetGeometryBoundsFunction(geometry, tellBox, nullptr);
    rtcSetGeometryIntersectFunction(geometry, visitFace);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) fail();
  }
  ~Embree() { release(); }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  void release() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  [[noreturn]] void fail() {
    const int error = rtcGetDeviceError(device);
    release();
    throw std::runtime_error("Embree cannot build its tree over " + std::to_string(boxes.size()) +
                             " faces: its error " + std::to_string(error));
  }

  std::vector<Box> boxes;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};

RayTree::RayTree(std::span<const SceneFace> faces) : embree_(std::make_unique<Embree>(faces)) {}
RayTree::~RayTree() = default;
RayTree::RayTree(RayTree&&) noexcept = default;
RayTree& RayTree::operator=(RayTree&&) noexcept = default;

void RayTree::visit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double& nearest,
                    const std::function<bool(std::size_t)>& visit) const {
  Visit context{{}, &nearest, &visit};
  rtcInitIntersectContext(&context.context);
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(origin.x());
  ray.ray.org_y = static_cast<float>(origin.y());
  ray.ray.org_z = static_cast<float>(origin.z());
  ray.ray.dir_x = static_cast<float>(direction.x());
  ray.ray.dir_y = static_cast<float>(direction.y());
  ray.ray.dir_z = static_cast<float>(direction.z());
  ray.ray.tnear = 0.0F;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->scene, &context.context, &ray);
}

}  // namespace irradiff
