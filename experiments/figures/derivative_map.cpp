#include "experiments/figures/derivative_map.h"

#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/number_text.h"
#include "verification/report/parallel_tasks.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace irradiff {
namespace {

constexpr double kFrameTolerance = 1e-12;
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// The order of the channels.
enum Channel : std::size_t {
  kIrradiance,
  kGradientX,
  kGradientY,
  kGradientZ,
  kHessianXX,
  kHessianXY,
  kHessianYY,
  kLambda1,
  kLambda2,
  kLambda3,
  kIrradianceBound,
  kGradientBound,
  kHessianBound,
  kEvent,
  kChannelCount
};

std::vector<MapChannel> emptyChannels(std::size_t count) {
  const char* const kE = "W/m^2";
  const char* const kGradient = "W/m^3";
  const char* const kHessian = "W/m^4";
  std::vector<MapChannel> channels{
      {"E", kE, "irradiance", ChannelKind::kAmount, {}},
      {"gradient.x", kGradient, "dE/dx, along the first side of the grid", ChannelKind::kSigned, {}},
      {"gradient.y", kGradient, "dE/dy, along the second side of the grid", ChannelKind::kSigned, {}},
      {"gradient.z", kGradient, "dE/dz, along the normal", ChannelKind::kSigned, {}},
      {"hessian.xx", kHessian, "second derivative along x twice", ChannelKind::kSigned, {}},
      {"hessian.xy", kHessian, "second derivative along x and y", ChannelKind::kSigned, {}},
      {"hessian.yy", kHessian, "second derivative along y twice", ChannelKind::kSigned, {}},
      {"lambda1", kHessian, "largest eigenvalue of the Hessian in space", ChannelKind::kSigned, {}},
      {"lambda2", kHessian, "middle eigenvalue of the Hessian in space", ChannelKind::kSigned, {}},
      {"lambda3", kHessian, "smallest eigenvalue of the Hessian in space", ChannelKind::kSigned, {}},
      {"bound.E", kE, "bound of the error of E", ChannelKind::kBound, {}},
      {"bound.gradient", kGradient, "bound of the error of the gradient", ChannelKind::kBound, {}},
      {"bound.hessian", kHessian, "bound of the error of the Hessian", ChannelKind::kBound, {}},
      {"event", "", "a visibility event passes between this receiver and a neighbour", ChannelKind::kFlag, {}},
  };
  for (MapChannel& channel : channels) {
    channel.values.assign(count, kMissing);
  }
  return channels;
}

/// The grid's axes as columns.
Eigen::Matrix3d frameOf(const ReceiverGrid& grid) {
  Eigen::Matrix3d frame;
  frame << grid.u.normalized(), grid.v.normalized(), grid.normal;
  return frame;
}

std::array<double, kChannelCount> valuesOf(const SceneEvaluation<3>& evaluation, const Eigen::Matrix3d& frame) {
  std::array<double, kChannelCount> values{};
  values.fill(kMissing);
  const IrradianceDerivatives<double, 3>& d = evaluation.derivatives;
  if (evaluation.no_irradiance.empty()) {
    values[kIrradiance] = d.irradiance.value;
    values[kIrradianceBound] = evaluation.bounds.irradiance;
  }
  if (evaluation.no_gradient.empty()) {
    const Eigen::Vector3d gradient = frame.transpose() * d.gradient.value;
    for (std::size_t i = 0; i < 3; ++i) {
      values[kGradientX + i] = gradient(static_cast<Eigen::Index>(i));
    }
    values[kGradientBound] = evaluation.bounds.gradient;
  }
  if (evaluation.no_tangential_hessian.empty()) {
    const Eigen::Matrix<double, 3, 2> tangents = frame.leftCols<2>();
    const Eigen::Matrix2d hessian = tangents.transpose() * d.hessian.value * tangents;
    values[kHessianXX] = hessian(0, 0);
    values[kHessianXY] = 0.5 * (hessian(0, 1) + hessian(1, 0));
    values[kHessianYY] = hessian(1, 1);
    values[kHessianBound] = evaluation.bounds.hessian;
  }
  if (evaluation.no_hessian.empty()) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(d.hessian.value, Eigen::EigenvaluesOnly);
    for (std::size_t i = 0; i < 3; ++i) {
      values[kLambda1 + i] = solver.eigenvalues()(2 - static_cast<Eigen::Index>(i));
    }
  }
  return values;
}

/// 1 for each point of a grid whose topology is not that of each neighbour.
std::vector<double> events(const std::vector<ViewTopology>& topologies, std::size_t width) {
  std::vector<double> flags(topologies.size(), 0.0);
  const auto compare = [&](std::size_t a, std::size_t b) {
    if (!(topologies[a] == topologies[b])) {
      flags[a] = flags[b] = 1.0;
    }
  };
  for (std::size_t i = 0; i < topologies.size(); ++i) {
    if (i % width + 1 < width) {
      compare(i, i + 1);
    }
    if (i + width < topologies.size()) {
      compare(i, i + width);
    }
  }
  return flags;
}

void requirePerpendicular(const char* names, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double cosine = a.dot(b) / (a.norm() * b.norm());
  if (!(std::abs(cosine) <= kFrameTolerance)) {
    throw InvalidScene(std::string("grid: the cosine of the angle between ") + names + " is " + numberText(cosine) +
                       ", a map needs at most " + numberText(kFrameTolerance) + " in magnitude");
  }
}

}  // namespace

const MapChannel& DerivativeMap::channel(std::string_view name) const {
  const auto found = std::ranges::find(channels, name, &MapChannel::name);
  if (found == channels.end()) {
    throw std::out_of_range("a map has no channel \"" + std::string(name) + '"');
  }
  return *found;
}

void validateFrame(const ReceiverGrid& grid) {
  for (const auto& [name, side] : {std::pair{"u", grid.u}, {"v", grid.v}}) {
    if (!(side.norm() > 0.0)) {
      throw InvalidScene(std::string("grid: ") + name + " has length " + numberText(side.norm()) +
                         ", must be longer than 0");
    }
  }
  requirePerpendicular("u and v", grid.u, grid.v);
  requirePerpendicular("u and the normal", grid.u, grid.normal);
  requirePerpendicular("v and the normal", grid.v, grid.normal);
  if (!(grid.u.cross(grid.v).dot(grid.normal) > 0.0)) {
    throw InvalidScene("grid: the normal " + pointText(grid.normal) +
                       " is opposite to u x v, a map needs u, v and the normal right-handed");
  }
}

DerivativeMap derivativeMap(const ReceiverGrid& grid, const ViewEvaluator& evaluate, unsigned threads,
                            const std::function<void(std::size_t, std::size_t)>& progress) {
  validateFrame(grid);
  const std::size_t count = grid.width * grid.height;
  DerivativeMap map{grid, emptyChannels(count)};
  const Eigen::Matrix3d frame = frameOf(grid);
  std::vector<ViewTopology> topologies(count);
  std::vector<std::function<void()>> rows;
  for (std::size_t j = 0; j < grid.height; ++j) {
    rows.emplace_back([&, j] {
      for (std::size_t i = 0; i < grid.width; ++i) {
        const std::size_t place = j * grid.width + i;
        ViewEvaluation view = evaluate(grid.receiver(i, j));
        const std::array<double, kChannelCount> values = valuesOf(view.evaluation, frame);
        for (std::size_t c = 0; c < kEvent; ++c) {
          map.channels[c].values[place] = values[c];
        }
        topologies[place] = std::move(view.topology);
      }
    });
  }
  runTasks(rows, threads, progress);
  map.channels[kEvent].values = events(topologies, grid.width);
  return map;
}

}  // namespace irradiff
