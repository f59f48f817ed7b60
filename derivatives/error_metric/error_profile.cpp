#include "derivatives/error_metric/error_profile.h"

#include "derivatives/scene/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSizeTolerance = 0x1p-10;
constexpr int kOrientations = 8;
constexpr int kAspects = 3;            ///< beside 1
constexpr double kNodesPerAspect = 8;  ///< of the trapezoidal rule
constexpr int kMostDoublings = 60;     ///< of a size, before it counts as infinite

/// The error along each ray, integrated from the record on with the weight rho^power: 1 for areas, 0 in flatland.
class RayIntegrals {
 public:
  RayIntegrals(const ErrorProfile& profile, int power)
      : distances_(profile.distances), errors_(profile.errors), power_(power), sums_(errors_.size()) {
    const std::size_t count = distances_.size();
    for (std::size_t k = 0; k < directions(); ++k) {
      double sum = quadraticPart(errors_[k * count], distances_[0], distances_[0]);
      sums_[k * count] = sum;
      for (std::size_t m = 1; m < count; ++m) {
        sum += linearPart(k * count + m, m, distances_[m]);
        sums_[k * count + m] = sum;
      }
    }
  }

  std::size_t directions() const { return errors_.size() / distances_.size(); }

  /// Of direction k up to `distance`.
  double upTo(std::size_t k, double distance) const {
    const std::size_t count = distances_.size();
    const std::size_t first = k * count;
    if (distance <= distances_.front()) return quadraticPart(errors_[first], distances_.front(), distance);
    if (distance >= distances_.back()) {
      const double error = errors_[first + count - 1];
      return sums_[first + count - 1] + (quadraticPart(error, distances_.back(), distance) -
                                         quadraticPart(error, distances_.back(), distances_.back()));
    }
    std::size_t m = 1;
    while (distances_[m] < distance) ++m;
    return sums_[first + m - 1] + linearPart(first + m, m, distance);
  }

 private:
  /// `error` (rho/at)^2 from 0 to `distance`.
  double quadraticPart(double error, double at, double distance) const {
    const double share = distance / at;
    const double length = error * distance * (share * share);
    return power_ == 0 ? length / 3.0 : length * distance / 4.0;
  }

  /// From the distance before m to `distance`, not beyond m.
  double linearPart(std::size_t index, std::size_t m, double distance) const {
    const double start = distances_[m - 1];
    const double step = distance - start;
    const double error = errors_[index - 1];
    const double last = error + (errors_[index] - error) * (step / (distances_[m] - start));
    if (power_ == 0) return 0.5 * step * (error + last);
    // Simpson's rule: a product of two linear functions is a parabola.
    return step / 6.0 * (start * error + (start + distance) * (error + last) + distance * last);
  }

  const std::vector<double>& distances_;
  const std::vector<float>& errors_;
  int power_;
  std::vector<double> sums_;  ///< of each error: the integral up to it
};

/// One term of a sum over rays: the integral of a direction up to `reach` times the size of the region.
struct Node {
  std::size_t direction;
  double reach;
  double weight;
};

/// A region but for its size.
struct Shape {
  std::vector<Node> nodes;
  double content = 0.0;        ///< area or length at size 1
  int dimension = 0;           ///< of the content
  double longest_reach = 0.0;  ///< at size 1

  double error(const RayIntegrals& rays, double size) const {
    double sum = 0.0;
    for (const Node& node : nodes) sum += node.weight * rays.upTo(node.direction, node.reach * size);
    return sum;
  }

  double contentAt(double size) const { return content * (dimension == 2 ? size * size : size); }
  double sizeOf(double content_there) const {
    const double ratio = content_there / content;
    return dimension == 2 ? std::sqrt(ratio) : ratio;
  }
};

/// Half-axes along the columns of `axes`.
Shape ellipse(const Eigen::Vector2d& half_axes, const Eigen::Matrix2d& axes, std::size_t directions) {
  Shape shape;
  shape.content = std::numbers::pi * half_axes.prod();
  shape.dimension = 2;
  shape.longest_reach = half_axes.maxCoeff();
  const double wanted = kNodesPerAspect * half_axes.maxCoeff() / half_axes.minCoeff();
  const auto parts = static_cast<std::size_t>(std::max(1.0, std::ceil(wanted / static_cast<double>(directions))));
  const double step = 2.0 * std::numbers::pi / static_cast<double>(directions * parts);
  shape.nodes.reserve(directions * (2 * parts - 1));
  for (std::size_t i = 0; i < directions * parts; ++i) {
    const double angle = step * static_cast<double>(i);
    const Eigen::Vector2d along = axes.transpose() * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const double reach = 1.0 / std::hypot(along(0) / half_axes(0), along(1) / half_axes(1));
    const double share = static_cast<double>(i % parts) / static_cast<double>(parts);
    shape.nodes.push_back({i / parts, reach, step * (1.0 - share)});
    if (share > 0.0) shape.nodes.push_back({(i / parts + 1) % directions, reach, step * share});
  }
  return shape;
}

/// [-1, 1] times the size.
Shape interval(std::size_t directions) {
  if (directions != 2) {
    throw std::invalid_argument("an error profile in flatland has " + std::to_string(directions) +
                                " directions, must have 2");
  }
  return {{{0, 1.0, 1.0}, {1, 1.0, 1.0}}, 2.0, 1, 1.0};
}

/// What is kept at the threshold, in units of irradiance.
struct Limit {
  const RayIntegrals& rays;
  double first_distance;
  double threshold;
  ErrorMeasure measure;

  /// What the error of a region of this content may be.
  double allowed(const Shape& shape, double size) const {
    return measure == ErrorMeasure::kMean ? threshold * shape.contentAt(size) : threshold;
  }

  bool holds(const Shape& shape, double size) const { return shape.error(rays, size) <= allowed(shape, size); }

  /// The first size in (low, high) at which it does not hold, `high` if there is none. It holds at `low`. Neither error
  /// nor content ever decreases: where the error at `high` is allowed at `low`, it holds in between.
  double firstBeyond(const Shape& shape, double low, double high) const {
    if (shape.error(rays, high) <= allowed(shape, low)) return high;
    if (high <= low * (1.0 + kSizeTolerance)) return holds(shape, high) ? high : low;
    const double middle = std::sqrt(low * high);
    const double first = firstBeyond(shape, low, middle);
    return first < middle ? first : firstBeyond(shape, middle, high);
  }

  /// The largest size up to which it holds, at most `most`.
  double largestSize(const Shape& shape, double most) const {
    // Up to the first distance the error is a power of the size.
    const double start = std::min(most, first_distance / shape.longest_reach);
    const double error = shape.error(rays, start);
    const double allowed_there = allowed(shape, start);
    if (error > allowed_there) {
      const int power = 2 + (measure == ErrorMeasure::kTotal ? shape.dimension : 0);
      return start * std::pow(allowed_there / error, 1.0 / power);
    }
    double low = start;
    for (int i = 0; i < kMostDoublings && low < most; ++i) {
      const double high = std::min(most, 2.0 * low);
      const double first = firstBeyond(shape, low, high);
      if (first < high) return first;
      low = high;
    }
    return low < most ? kInfinity : most;
  }
};

bool isZero(const ErrorProfile& profile) {
  return std::ranges::all_of(profile.errors, [](float error) { return error == 0.0f; });
}

double thresholdOf(Irradiance<double> irradiance, double threshold, ErrorScale scale) {
  if (scale == ErrorScale::kAbsolute) return threshold;
  if (!(irradiance.value > 0.0)) {
    throw std::invalid_argument("the irradiance of a record is " + numberText(irradiance.value) +
                                ", must be positive for a relative error unless the error is zero everywhere");
  }
  return threshold * irradiance.value;
}

}  // namespace

void ErrorProfile::require() const {
  if (distances.empty() || errors.empty() || errors.size() % distances.size() != 0) {
    throw std::invalid_argument("an error profile has " + std::to_string(distances.size()) + " distances and " +
                                std::to_string(errors.size()) +
                                " errors, must have one error for each distance of each direction");
  }
  double last = 0.0;
  for (const double distance : distances) {
    if (!(distance > last) || std::isinf(distance)) {
      throw std::invalid_argument("a distance of an error profile is " + numberText(distance) + " after " +
                                  numberText(last) + ", must be larger and finite");
    }
    last = distance;
  }
  for (const float error : errors) {
    if (!(error >= 0.0f) || std::isinf(error)) {
      throw std::invalid_argument("an error of an error profile is " + numberText(error) + ", must be finite and >= 0");
    }
  }
}

double integratedError(const ErrorProfile& profile, const ValidRegion& region) {
  profile.require();
  return ellipse(region.half_axes, region.axes, profile.directions()).error(RayIntegrals(profile, 1), 1.0);
}

ValidRegion largestEllipse(const ErrorProfile& profile, Irradiance<double> irradiance, double threshold,
                           const EllipseOptions& options, double smallest_radius, double largest_radius) {
  profile.require();
  const auto circle = [](double radius) {
    return ValidRegion{Eigen::Vector2d::Constant(radius), Eigen::Matrix2d::Identity()};
  };
  if (isZero(profile)) return circle(largest_radius);
  const RayIntegrals rays(profile, 1);
  const Limit limit{rays, profile.distances.front(), thresholdOf(irradiance, threshold, options.scale),
                    options.measure};
  const std::size_t directions = profile.directions();

  const Shape round = ellipse(Eigen::Vector2d::Ones(), Eigen::Matrix2d::Identity(), directions);
  ValidRegion best = circle(limit.largestSize(round, largest_radius));
  double area = round.contentAt(best.half_axes(0));
  for (int i = 0; i < kAspects && options.largest_aspect > 1.0 && std::isfinite(area); ++i) {
    const double aspect = std::pow(options.largest_aspect, (i + 1.0) / kAspects);
    for (int orientation = 0; orientation < kOrientations; ++orientation) {
      const double angle = std::numbers::pi * orientation / kOrientations;
      Eigen::Matrix2d axes;
      axes << std::sin(angle), std::cos(angle), -std::cos(angle), std::sin(angle);
      const Shape shape = ellipse({1.0, aspect}, axes, directions);
      // No larger than the best one: not looked at again.
      const double rival = shape.sizeOf(area) * (1.0 + kSizeTolerance);
      if (!(aspect * rival <= largest_radius) || !limit.holds(shape, rival)) continue;
      const double size = limit.largestSize(shape, largest_radius / aspect);
      if (!(shape.contentAt(size) > area)) continue;
      area = shape.contentAt(size);
      best = {{size, aspect * size}, axes};
    }
  }
  best.half_axes = best.half_axes.cwiseMax(smallest_radius);
  return best;
}

double integratedIntervalError(const ErrorProfile& profile, double half_length) {
  profile.require();
  return interval(profile.directions()).error(RayIntegrals(profile, 0), half_length);
}

double largestInterval(const ErrorProfile& profile, Irradiance<double> irradiance, double threshold, ErrorScale scale,
                       ErrorMeasure measure, double smallest_half_length, double largest_half_length) {
  profile.require();
  const Shape shape = interval(profile.directions());
  if (isZero(profile)) return largest_half_length;
  const RayIntegrals rays(profile, 0);
  const Limit limit{rays, profile.distances.front(), thresholdOf(irradiance, threshold, scale), measure};
  return std::max(smallest_half_length, limit.largestSize(shape, largest_half_length));
}

}  // namespace irradiff
