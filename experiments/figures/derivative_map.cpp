#include "experiments/figures/derivative_map.h"

#include "derivatives/boundary/irradiance.h"
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
#include <mutex>
#include <stdexcept>
#include <utility>

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
  kTangentialBound,
  kHessianBound,
  kGapFilling,
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
      {"bound.tangential_hessian", kHessian, "bound of the error of the tangential Hessian", ChannelKind::kBound, {}},
      {"bound.hessian", kHessian, "bound of the error of the Hessian in space", ChannelKind::kBound, {}},
      {"gap.hessian", "1", "share of the Hessian that filling gaps loses", ChannelKind::kAmount, {}},
      {"event", "", "a visibility event passes between this receiver and a neighbour", ChannelKind::kFlag, {}},
  };
  for (MapChannel& channel : channels) {
    channel.values.assign(count, kMissing);
  }
  return channels;
}

/// The axes of a grid.
struct GridFrame {
  explicit GridFrame(const ReceiverGrid& grid) {
    axes << grid.u.normalized(), grid.v.normalized(), grid.normal;
    tangents = tangentFrame(grid.normal).transpose() * axes.leftCols<2>();
  }

  Eigen::Matrix3d axes;      ///< as columns
  Eigen::Matrix2d tangents;  ///< the first two, in the frame of tangentFrame(normal)
};

std::array<double, kChannelCount> valuesOf(const ViewEvaluation& view, const GridFrame& frame) {
  const SceneEvaluation<3>& evaluation = view.evaluation;
  std::array<double, kChannelCount> values{};
  values.fill(kMissing);
  const IrradianceDerivatives<double, 3>& d = evaluation.derivatives;
  if (evaluation.no_irradiance.empty()) {
    values[kIrradiance] = d.irradiance.value;
    values[kIrradianceBound] = evaluation.bounds.irradiance;
  }
  if (evaluation.no_gradient.empty()) {
    const Eigen::Vector3d gradient = frame.axes.transpose() * d.gradient.value;
    for (std::size_t i = 0; i < 3; ++i) {
      values[kGradientX + i] = gradient(static_cast<Eigen::Index>(i));
    }
    values[kGradientBound] = evaluation.bounds.gradient;
  }
  if (evaluation.no_tangential_hessian.empty()) {
    const Eigen::Matrix2d hessian = frame.tangents.transpose() * d.tangential_hessian.value * frame.tangents;
    values[kHessianXX] = hessian(0, 0);
    values[kHessianXY] = 0.5 * (hessian(0, 1) + hessian(1, 0));
    values[kHessianYY] = hessian(1, 1);
    values[kTangentialBound] = evaluation.bounds.tangential_hessian;
  }
  if (evaluation.no_hessian.empty()) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(d.hessian.value, Eigen::EigenvaluesOnly);
    for (std::size_t i = 0; i < 3; ++i) {
      values[kLambda1 + i] = solver.eigenvalues()(2 - static_cast<Eigen::Index>(i));
    }
    values[kHessianBound] = evaluation.bounds.hessian;
    const double size = d.hessian.value.cwiseAbs().maxCoeff();
    const double loss = (view.gap_filled_hessian.value - d.hessian.value).cwiseAbs().maxCoeff();
    values[kGapFilling] = loss == 0.0 ? 0.0 : loss / size;
  }
  return values;
}

/// Marks the receivers of a grid beside a visibility event. A row's topologies, which are large, are kept until both
/// neighbouring rows have come, in whatever order.
class EventMarks {
 public:
  EventMarks(std::size_t width, std::size_t height) : flags_(width * height, 0.0), rows_(height), missing_(height, 2) {
    --missing_.front();
    --missing_.back();
  }

  void addRow(std::size_t j, std::vector<VisibleBoundary> row) {
    const std::scoped_lock lock(mutex_);
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      compare(row[i], j * row.size() + i, row[i + 1], j * row.size() + i + 1);
    }
    rows_[j] = std::move(row);
    if (j > 0) {
      compareRows(j - 1, j);
    }
    if (j + 1 < rows_.size()) {
      compareRows(j, j + 1);
    }
  }

  std::vector<double> flags() && { return std::move(flags_); }

 private:
  void compare(const VisibleBoundary& a, std::size_t a_place, const VisibleBoundary& b, std::size_t b_place) {
    if (!(a == b)) {
      flags_[a_place] = flags_[b_place] = 1.0;
    }
  }

  void compareRows(std::size_t below, std::size_t above) {
    const std::size_t width = rows_[below].size();
    if (width == 0 || rows_[above].empty()) {
      return;
    }
    for (std::size_t i = 0; i < width; ++i) {
      compare(rows_[below][i], below * width + i, rows_[above][i], above * width + i);
    }
    for (const std::size_t j : {below, above}) {
      if (--missing_[j] == 0) {
        rows_[j] = {};
      }
    }
  }

  std::mutex mutex_;
  std::vector<double> flags_;
  std::vector<std::vector<VisibleBoundary>> rows_;  ///< empty before it has come and when it is done with
  std::vector<int> missing_;                        ///< neighbouring rows that each has not been compared with
};

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
  const GridFrame frame(grid);
  EventMarks marks(grid.width, grid.height);
  std::vector<std::function<void()>> rows;
  for (std::size_t j = 0; j < grid.height; ++j) {
    rows.emplace_back([&, j] {
      std::vector<VisibleBoundary> topologies;
      topologies.reserve(grid.width);
      for (std::size_t i = 0; i < grid.width; ++i) {
        ViewEvaluation view = evaluate(grid.receiver(i, j));
        const std::array<double, kChannelCount> values = valuesOf(view, frame);
        for (std::size_t c = 0; c < kEvent; ++c) {
          map.channels[c].values[j * grid.width + i] = values[c];
        }
        topologies.push_back(std::move(view.topology));
      }
      marks.addRow(j, std::move(topologies));
    });
  }
  runTasks(rows, threads, progress);
  map.channels[kEvent].values = std::move(marks).flags();
  return map;
}

DerivativeMap derivativesAt(std::span<const Receiver> receivers, const ReceiverGrid& axes,
                            const ViewEvaluator& evaluate, unsigned threads,
                            const std::function<void(std::size_t, std::size_t)>& progress) {
  validateFrame(axes);
  DerivativeMap map{axes, emptyChannels(receivers.size())};
  map.grid.width = receivers.size();
  map.grid.height = 1;
  const GridFrame frame(axes);
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    tasks.emplace_back([&, i] {
      const std::array<double, kChannelCount> values = valuesOf(evaluate(receivers[i]), frame);
      for (std::size_t c = 0; c < kEvent; ++c) {
        map.channels[c].values[i] = values[c];
      }
    });
  }
  runTasks(tasks, threads, progress);
  std::ranges::fill(map.channels[kEvent].values, 0.0);
  return map;
}

ExrImage exrImage(const DerivativeMap& map, std::span<const MapChannel> more) {
  const ReceiverGrid& grid = map.grid;
  ExrImage image{grid.width, grid.height, {}, {}};
  const auto add = [&](const MapChannel& channel) {
    std::vector<double> values;
    values.reserve(channel.values.size());
    for (std::size_t row = grid.height; row-- > 0;) {
      const auto begin = channel.values.begin() + static_cast<std::ptrdiff_t>(row * grid.width);
      values.insert(values.end(), begin, begin + static_cast<std::ptrdiff_t>(grid.width));
    }
    image.channels.push_back({channel.name, std::move(values)});
  };
  std::ranges::for_each(map.channels, add);
  std::ranges::for_each(more, add);
  return image;
}

}  // namespace irradiff
