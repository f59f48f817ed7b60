#include "experiments/cache_2d/interval_search.h"

#include <algorithm>
#include <limits>

namespace irradiff {
namespace {

/// Integrates the error of one side from 0 to ascending radii.
class RunningIntegral {
 public:
  explicit RunningIntegral(const SideError& side) : side_(side) {}

  double next() const {
    return place_ < side_.distances.size() ? side_.distances[place_] : std::numeric_limits<double>::infinity();
  }

  /// From 0 to a radius that is at most next().
  double upTo(double radius) const {
    if (place_ == side_.distances.size()) return sum_;
    const double end = side_.distances[place_];
    const double end_error = side_.errors[place_];
    if (place_ == 0) {
      const double share = radius / end;
      return end_error * radius * share * share / 3.0;
    }
    const double start = side_.distances[place_ - 1];
    if (end == start) return sum_;
    const double start_error = side_.errors[place_ - 1];
    const double step = radius - start;
    return sum_ + step * (start_error + 0.5 * (end_error - start_error) * step / (end - start));
  }

  void pass(double radius) {
    while (next() <= radius) {
      sum_ = upTo(next());
      ++place_;
    }
  }

 private:
  const SideError& side_;
  std::size_t place_ = 0;
  double sum_ = 0.0;
};

}  // namespace

double integratedError(const SideError& before, const SideError& after, double half_length) {
  double sum = 0.0;
  for (const SideError* side : {&before, &after}) {
    RunningIntegral integral(*side);
    integral.pass(half_length);
    sum += integral.upTo(half_length);
  }
  return sum;
}

double intervalOfError(const SideError& before, const SideError& after, double threshold, ErrorMeasure measure) {
  RunningIntegral left(before);
  RunningIntegral right(after);
  const auto exceeds = [&](double radius) {
    const double allowed = measure == ErrorMeasure::kMean ? 2.0 * radius * threshold : threshold;
    return left.upTo(radius) + right.upTo(radius) > allowed;
  };
  double passed = 0.0;
  for (;;) {
    const double next = std::min(left.next(), right.next());
    if (next == std::numeric_limits<double>::infinity()) return next;
    if (exceeds(next)) {
      double low = passed;
      double high = next;
      for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high)) {
        (exceeds(middle) ? high : low) = middle;
      }
      return low;
    }
    left.pass(next);
    right.pass(next);
    passed = next;
  }
}

}  // namespace irradiff
