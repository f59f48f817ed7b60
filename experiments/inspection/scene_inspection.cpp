#include "experiments/inspection/scene_inspection.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace irradiff {
namespace {

/// Three digits, for people.
std::string brief(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

template <int Dimension>
std::string positionText(const Eigen::Matrix<double, Dimension, 1>& position) {
  std::string text = "[";
  for (int i = 0; i < Dimension; ++i) {
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%.6g", position(i));
    text += (i > 0 ? ", " : "") + std::string(number.data());
  }
  return text + "]";
}

/// Why a Hessian is of the use that it is of.
template <int Dimension>
std::string reasonOf(const PointInspection<Dimension>& point) {
  switch (point.hessian) {
    case HessianUse::kMissing:
      return point.evaluation.no_hessian +
             (point.evaluation.no_tangential_hessian.empty() ? "; the tangential Hessian exists" : "");
    case HessianUse::kUndecided:
      return point.jump->what + " " + brief(point.jump->distance) + " m away, and rounded coordinates tell that to " +
             brief(point.jump->rounding) + " m";
    case HessianUse::kUncertain:
      return "the error bound " + brief(point.evaluation.bounds.hessian) + " beside a largest entry of " +
             brief(point.evaluation.derivatives.hessian.value.cwiseAbs().maxCoeff());
    case HessianUse::kShort:
      return point.jump->what + " " + brief(point.jump->distance) + " m away; asked for " +
             (std::isinf(point.promised_range) ? "any distance" : "up to " + brief(point.promised_range) + " m") +
             (point.changes_within ? "; the view does change within " + brief(*point.changes_within) + " m" : "");
    case HessianUse::kGood:
      break;
  }
  return "";
}

/// How bad that is, among those of the same use.
template <int Dimension>
double severityOf(const PointInspection<Dimension>& point) {
  switch (point.hessian) {
    case HessianUse::kUndecided:
    case HessianUse::kShort:
      return -point.jump->distance / std::max(point.promised_range, point.jump->rounding);
    case HessianUse::kUncertain:
      return point.evaluation.bounds.hessian / point.evaluation.derivatives.hessian.value.cwiseAbs().maxCoeff();
    case HessianUse::kMissing:
    case HessianUse::kGood:
      break;
  }
  return 0.0;
}

/// Groups by what is to be said, in a fixed order.
class Groups {
 public:
  void add(std::size_t order, const std::string& title, NotedPoint point) {
    if (groups_.size() <= order) groups_.resize(order + 1);
    NotedGroup& group = groups_[order];
    group.title = title;
    ++group.count;
    std::vector<NotedPoint>& worst = group.worst;
    if (const auto same = std::ranges::find(worst, point.text, &NotedPoint::text); same != worst.end()) {
      ++same->count;
      return;
    }
    if (worst.size() == kNotedPoints) {
      if (point.severity <= worst.back().severity) return;
      worst.pop_back();
    }
    const auto isWorse = [](const NotedPoint& a, const NotedPoint& b) { return a.severity > b.severity; };
    worst.insert(std::upper_bound(worst.begin(), worst.end(), point, isWorse), std::move(point));
  }
  std::vector<NotedGroup> filled() const {
    std::vector<NotedGroup> filled;
    std::ranges::copy_if(groups_, std::back_inserter(filled), [](const NotedGroup& group) { return group.count > 0; });
    return filled;
  }

 private:
  std::vector<NotedGroup> groups_;
};

const char* titleOf(HessianUse use) {
  switch (use) {
    case HessianUse::kMissing:
      return "the Hessian does not exist";
    case HessianUse::kUndecided:
      return "at a visibility event but for the rounding of coordinates: the Hessian may be the other side's";
    case HessianUse::kUncertain:
      return "the Hessian's error bound is more than 1 % of it";
    case HessianUse::kShort:
      return "a visibility event is nearer than half the range that the Hessian promises";
    case HessianUse::kGood:
      break;
  }
  return "";
}

/// Adds one receiver to the figures.
class Tally {
 public:
  Tally(const Scene& scene, SceneInspection& inspection) : scene_(scene), inspection_(inspection) {}

  template <int Dimension>
  void add(std::size_t index, const PointInspection<Dimension>& point) {
    const SceneEvaluation<Dimension>& e = point.evaluation;
    ++inspection_.receivers;
    if (e.has_occlusion) ++inspection_.with_occlusion;
    if (e.crosses_horizon) ++inspection_.with_horizon;
    if (e.apparent_vertices > 0) ++inspection_.with_apparent_vertices;
    inspection_.apparent_vertices.add(static_cast<double>(e.apparent_vertices));
    for (std::size_t i = 0; e.sources && i < kTreatments.size(); ++i) {
      inspection_.treatments[i].add(static_cast<double>(*e.sources.*kTreatments[i].count));
    }
    ++inspection_.rungs[static_cast<std::size_t>(point.rung)];
    inspection_.relative_bounds.add(point.loosest_bound.relative);
    ++inspection_.hessians[static_cast<std::size_t>(point.hessian)];
    if (point.event) inspection_.event_distances.add(point.event->distance);
    if (point.jump) inspection_.jump_distances.add(point.jump->distance);
    if (point.promised_range > 0.0) inspection_.promised_ranges.add(point.promised_range);
    if (point.cost) inspection_.costs.add(*point.cost);
    note(index, point);
  }

  std::vector<NotedGroup> groups() const { return groups_.filled(); }

 private:
  template <int Dimension>
  void note(std::size_t index, const PointInspection<Dimension>& point) {
    NotedPoint named;
    named.index = index;
    named.name = nameOf(index);
    named.position = positionText<Dimension>(point.receiver.position);
    if (point.hessian != HessianUse::kGood) {
      NotedPoint noted = named;
      noted.text = reasonOf(point);
      noted.severity = severityOf(point);
      groups_.add(static_cast<std::size_t>(point.hessian), titleOf(point.hessian), std::move(noted));
    }
    if (point.rung != Rung::kDouble) {
      NotedPoint noted = named;
      noted.severity = point.loosest_bound.relative;
      const double relative = point.loosest_bound.relative;
      noted.text = std::isinf(relative) ? textOf(point.loosest_bound.quantity) + " is 0 in double, with a bound above 0"
                                        : "the bound of " + textOf(point.loosest_bound.quantity) + " in double is " +
                                              brief(relative) + " times its largest entry";
      groups_.add(
          kHessianUses.size() + static_cast<std::size_t>(point.rung),
          std::string("double does not reach the tolerance: ") + irradiff::nameOf(point.rung) + " precision expected",
          std::move(noted));
    }
  }

  static std::string textOf(std::string_view quantity) {
    std::string text(quantity);
    std::ranges::replace(text, '_', ' ');
    return "the " + text;
  }

  std::string nameOf(std::size_t index) const {
    const std::size_t points = pointCount(scene_);
    if (index < points) return "points[" + std::to_string(index) + "]";
    const std::size_t cell = index - points;
    return "grid (" + std::to_string(cell % scene_.grid->width) + ", " + std::to_string(cell / scene_.grid->width) +
           ")";
  }

  const Scene& scene_;
  SceneInspection& inspection_;
  Groups groups_;
};

}  // namespace

const std::array<Treatment, 8> kTreatments = {{
    {"area_rule", "seen whole and small: area rule", &SourceCounts::area_rule},
    {"boundary", "seen whole: along the edges", &SourceCounts::boundary},
    {"partly_hidden", "partly hidden", &SourceCounts::partly_hidden},
    {"black", "black: skipped, may hide", &SourceCounts::black},
    {"hidden", "hidden: skipped", &SourceCounts::hidden},
    {"edge_on", "seen edge-on", &SourceCounts::edge_on},
    {"own_surface", "the receiver's own surface", &SourceCounts::own_surface},
    {"below_horizon", "below the horizon", &SourceCounts::below_horizon},
}};

void ValueRange::add(double value) {
  if (std::isfinite(value)) {
    values_.push_back(value);
  } else {
    ++infinite_;
  }
}

double ValueRange::least() const { return *std::ranges::min_element(values_); }

double ValueRange::median() const {
  std::vector<double> sorted = values_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

double ValueRange::largest() const { return *std::ranges::max_element(values_); }

double ValueRange::sum() const { return std::accumulate(values_.begin(), values_.end(), 0.0); }

std::size_t pointCount(const Scene& scene) {
  if (scene.dimension == 2) return scene.flatland_receivers.size();
  return scene.receivers.size() - (scene.grid ? scene.grid->width * scene.grid->height : 0);
}

SceneInspection inspectScene(const Scene& scene, double tolerance, const InspectionSinks& sinks) {
  SceneInspection inspection;
  inspection.dimension = scene.dimension;
  inspection.description = scene.description;
  inspection.tolerance = tolerance;
  Tally tally(scene, inspection);
  const auto inspectAll = [&](const auto& receivers, const auto& take, const auto& inspect) {
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const auto point = inspect(i, receivers[i]);
      tally.add(i, point);
      if (take) take(i, point);
      if (sinks.progress) sinks.progress(i + 1, receivers.size());
    }
  };
  if (scene.dimension == 2) {
    inspection.sources = scene.segments.size();
    inspectAll(scene.flatland_receivers, sinks.take_flatland, [&](std::size_t, const FlatlandReceiver& receiver) {
      return inspectPoint(scene.segments, receiver, tolerance);
    });
  } else {
    inspection.sources = scene.polygons.size();
    const SceneEvaluator evaluator(scene.polygons);
    const std::size_t points = pointCount(scene);
    inspectAll(scene.receivers, sinks.take, [&](std::size_t i, const Receiver& receiver) {
      PointInspection<3> point = inspectPoint(evaluator, receiver, tolerance);
      if (i < points) point.changes_within = confirmedChange(evaluator, receiver);
      return point;
    });
  }
  inspection.groups = tally.groups();
  return inspection;
}

}  // namespace irradiff
