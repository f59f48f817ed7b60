#include "experiments/cache/irradiance_cache.h"

#include "derivatives/scene/number_text.h"

#include <Eigen/Geometry>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace irradiff {
namespace {

using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
using Box = boost::geometry::model::box<Corner>;

/// Boxes end here, so that the volumes that the tree compares are finite.
constexpr double kFarthestBorder = 1e100;

Corner cornerOf(const Eigen::Vector3d& position) {
  const Eigen::Vector3d inside = position.cwiseMin(kFarthestBorder).cwiseMax(-kFarthestBorder);
  return {inside(0), inside(1), inside(2)};
}

/// Of the ellipsoid t_x <= 1 of Eq. (17).
Box boxOf(const CacheRecord& record) {
  const Eigen::Vector2d half_axes = record.half_axes.cwiseMin(kFarthestBorder);
  const double across = half_axes.minCoeff();
  Eigen::Vector3d extent;
  for (int i = 0; i < 3; ++i) {
    extent(i) = std::hypot(half_axes(0) * record.first_axis(i), half_axes(1) * record.second_axis(i),
                           across * record.receiver.normal(i));
  }
  // Wider than the rounding errors of position and distance.
  constexpr double kMargin = 1e-12;
  extent = extent * (1.0 + kMargin) + kMargin * record.receiver.position.cwiseAbs();
  return {cornerOf(record.receiver.position - extent), cornerOf(record.receiver.position + extent)};
}

/// The length of n - n_i where the angle between both is `normal_deviation`.
double longestDifference(double normal_deviation) { return 2.0 * std::sin(0.5 * normal_deviation); }

// k(n.n_i, cos(angle), 1) of Eqs. (16) and (18) by |n - n_i|^2 = 2 (1 - n.n_i), which does not lose small angles.
double normalTent(const CacheRecord& record, const Receiver& receiver, double longest_difference) {
  return 1.0 - (receiver.normal - record.receiver.normal).squaredNorm() / (longest_difference * longest_difference);
}

double weightWithin(const CacheRecord& record, const Receiver& receiver, double longest_difference) {
  // Not the product's sign: two negative tents are no weight.
  const double normal_tent = normalTent(record, receiver, longest_difference);
  if (!(normal_tent > 0.0)) return 0.0;
  return std::max(0.0, 1.0 - translationalDistance(record, receiver.position)) * normal_tent;
}

void requireRecord(const CacheRecord& record, std::size_t number) {
  const auto refuse = [number](const std::string& reason) {
    throw std::invalid_argument("cache record " + std::to_string(number) + ": " + reason);
  };
  if (!(record.half_axes.array() > 0.0).all()) {
    refuse("the half-axes of its region are " + pointText(record.half_axes) + ", must be positive");
  }
  if (!record.receiver.position.allFinite() || !record.receiver.normal.allFinite()) {
    refuse("position " + pointText(record.receiver.position) + " and normal " + pointText(record.receiver.normal) +
           " must be finite");
  }
  if (!record.first_axis.allFinite() || !record.second_axis.allFinite()) {
    refuse("the axes of its region are " + pointText(record.first_axis) + " and " + pointText(record.second_axis) +
           ", must be finite");
  }
  if (!std::isfinite(record.irradiance)) {
    refuse("the irradiance is " + numberText(record.irradiance) + ", must be finite");
  }
  if (!record.gradient.allFinite() || !record.rotational_gradient.allFinite() || !record.hessian.allFinite()) {
    refuse("the gradients " + pointText(record.gradient) + " and " + pointText(record.rotational_gradient) +
           " and the Hessian must be finite");
  }
}

}  // namespace

double translationalDistance(const CacheRecord& record, const Eigen::Vector3d& position) {
  const Eigen::Vector3d step = position - record.receiver.position;
  const double first = step.dot(record.first_axis) / record.half_axes(0);
  const double second = step.dot(record.second_axis) / record.half_axes(1);
  const double across = step.dot(record.receiver.normal) / record.half_axes.minCoeff();
  return std::sqrt(first * first + second * second + across * across);
}

double weight(const CacheRecord& record, const Receiver& receiver, double normal_deviation) {
  return weightWithin(record, receiver, longestDifference(normal_deviation));
}

double extrapolated(const CacheRecord& record, const Receiver& receiver) {
  const Eigen::Vector3d step = receiver.position - record.receiver.position;
  // The pair of a derivative with respect to a rotation vector: docs/errata.md, Equation (15).
  const Eigen::Vector3d turn = record.receiver.normal.cross(receiver.normal);
  return record.irradiance + record.gradient.dot(step) + record.rotational_gradient.dot(turn) +
         0.5 * step.dot(record.hessian * step);
}

struct IrradianceCache::Tree {
  using Entry = std::pair<Box, std::size_t>;
  struct SameRecord {
    bool operator()(const Entry& a, const Entry& b) const { return a.second == b.second; }
  };

  double longest_difference;
  std::vector<CacheRecord> records;
  boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>, boost::geometry::index::indexable<Entry>,
                                SameRecord>
      boxes;

  /// Calls `visit` with the number of each record whose box has the point in it.
  template <class Visit>
  void visitAround(const Eigen::Vector3d& position, Visit visit) const {
    boxes.query(boost::geometry::index::intersects(cornerOf(position)),
                boost::make_function_output_iterator([&](const Entry& entry) { visit(entry.second); }));
  }
};

IrradianceCache::IrradianceCache(double normal_deviation) {
  if (!(normal_deviation > 0.0 && normal_deviation <= 0.5 * std::numbers::pi)) {
    throw std::invalid_argument("the largest deviation of normals is " + numberText(normal_deviation) +
                                " rad, must be in (0, pi/2]");
  }
  tree_ = std::make_unique<Tree>();
  tree_->longest_difference = longestDifference(normal_deviation);
}

IrradianceCache::~IrradianceCache() = default;
IrradianceCache::IrradianceCache(IrradianceCache&&) noexcept = default;
IrradianceCache& IrradianceCache::operator=(IrradianceCache&&) noexcept = default;

void IrradianceCache::add(const CacheRecord& record) {
  requireRecord(record, tree_->records.size());
  tree_->boxes.insert({boxOf(record), tree_->records.size()});
  tree_->records.push_back(record);
}

std::optional<double> IrradianceCache::interpolate(const Receiver& receiver) const {
  std::vector<std::pair<std::size_t, double>> serving;
  tree_->visitAround(receiver.position, [&](std::size_t i) {
    const double w = weightWithin(tree_->records[i], receiver, tree_->longest_difference);
    if (w > 0.0) serving.emplace_back(i, w);
  });
  if (serving.empty()) return std::nullopt;
  std::ranges::sort(serving);
  double weighted = 0.0;
  double weights = 0.0;
  for (const auto& [i, w] : serving) {
    weighted += w * extrapolated(tree_->records[i], receiver);
    weights += w;
  }
  return std::max(0.0, weighted / weights);
}

bool IrradianceCache::serves(const Receiver& receiver) const {
  const auto end = tree_->boxes.qend();
  for (auto i = tree_->boxes.qbegin(boost::geometry::index::intersects(cornerOf(receiver.position))); i != end; ++i) {
    if (weightWithin(tree_->records[i->second], receiver, tree_->longest_difference) > 0.0) return true;
  }
  return false;
}

const std::vector<CacheRecord>& IrradianceCache::records() const { return tree_->records; }

void IrradianceCache::shrink(std::size_t record, double radius) {
  CacheRecord& shrunk = tree_->records[record];
  const double shorter = shrunk.half_axes.minCoeff();
  if (shorter <= radius) return;
  tree_->boxes.remove({boxOf(shrunk), record});
  if (std::isinf(shorter)) {
    shrunk.half_axes.setConstant(radius);
  } else {
    shrunk.half_axes *= radius / shorter;
  }
  tree_->boxes.insert({boxOf(shrunk), record});
}

std::vector<std::size_t> IrradianceCache::recordsAround(const Eigen::Vector3d& position) const {
  std::vector<std::size_t> result;
  tree_->visitAround(position, [&](std::size_t i) {
    if (translationalDistance(tree_->records[i], position) < 1.0) result.push_back(i);
  });
  std::ranges::sort(result);
  return result;
}

}  // namespace irradiff
