#include "derivatives/form_factor/plain_boundary.h"

#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/edge_kernel.h"
#include "derivatives/boundary/small_source.h"
#include "derivatives/form_factor/plain_geometry.h"
#include "derivatives/form_factor/plain_rules.h"

#include <cmath>
#include <limits>

namespace irradiff {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;
/// Beyond it even doubled precision leaves r x e with more than its rounding.
constexpr double kLargestCancellation = 0x1p40;
/// What an arc's own bound may reach: the count is one to first order.
constexpr double kLargestRelativeError = 0x1p-6;

class BoundarySum {
 public:
  BoundarySum(const PlainView& view, const Polygon& polygon, const Receiver& receiver,
              const PlainBoundarySettings& settings)
      : view_(view), polygon_(polygon), receiver_(receiver), settings_(settings) {}

  PlainResult result() {
    for (std::size_t i = 0; i < view_.count; ++i) {
      addEdge(i, view_.next(i));
      if (is_lost_) {
        return withoutBounds();
      }
    }
    if (is_below_) {
      addHorizon(last_cut_, first_cut_);
    }
    return summed();
  }

 private:
  void addEdge(std::size_t i, std::size_t next) {
    const PlainVertex& a = view_.vertices[i];
    const PlainVertex& b = view_.vertices[next];
    if (a.height < 0.0 && b.height < 0.0) {
      return;
    }
    const Vector3<double> edge = (polygon_.vertices[next] - polygon_.vertices[i]) * view_.scale;
    const bool from_start = a.inverse_distance >= b.inverse_distance;
    const PlainVertex& nearer = from_start ? a : b;
    Vector3<double> moment = cross<double>(nearer.position, edge);
    double area = norm(moment);
    const double length = norm(edge);
    const double terms = length / nearer.inverse_distance;
    // Relative error of the moment in units of u, beyond its last rounding.
    double moment_error = kPlainMomentError * terms / area;
    if (!(terms <= settings_.largest_cancellation * area)) {
      const std::size_t near_index = from_start ? i : next;
      moment = narrow<double>(cross(wideRelative(polygon_.vertices[near_index], receiver_.position, view_.scale),
                                    wideRelative(polygon_.vertices[next], polygon_.vertices[i], view_.scale)));
      area = norm(moment);
      moment_error = 0x1p-8;
      if (!(terms <= kLargestCancellation * area)) {
        is_lost_ = true;
        return;
      }
    }
    const PlainEdge<double> whole{endOf(a), endOf(b), edge, length, moment, area};
    if (a.height > 0.0 && b.height > 0.0) {
      add(whole, moment_error, 0.0);
    } else {
      addCutEdge(whole, i, next, moment_error);
    }
  }

  static PlainEnd<double> endOf(const PlainVertex& vertex) {
    return {vertex.position, vertex.inverse_distance, vertex.cosine, vertex.height};
  }

  void add(const PlainEdge<double>& edge, double moment_error, double cut_error) {
    if (sums_.arcs == 0) {
      origin_ = edge.first.position;
    }
    extent_ = std::max(extent_, (edge.last.position - origin_).squaredNorm());
    addPlainEdge(edge, {moment_error, view_.height_error, cut_error}, settings_.series_lengths, receiver_.normal,
                 sums_);
  }

  void addCutEdge(const PlainEdge<double>& whole, std::size_t start, std::size_t end, double moment_error) {
    const PlainEnd<double>& a = whole.first;
    const PlainEnd<double>& b = whole.last;
    const bool starts_above = a.height > 0.0;
    const PlainEnd<double>& seen = starts_above ? a : b;
    const PlainEnd<double>& hidden = starts_above ? b : a;
    double fraction = seen.height / (seen.height - hidden.height);
    Vector3<double> position = seen.position + (starts_above ? fraction : -fraction) * whole.edge;
    double distance = norm(position);
    // The fraction is off by this much, in units of u, and moves the cut along the edge; beside that the cut has the
    // rounding of the end that is seen.
    double cut_error = 2.0 * view_.height_error + 8.0;
    double rounding = 4.0 * kUnitRoundoff * (1.0 + 1.0 / (seen.inverse_distance * distance));
    double shift = cut_error * kUnitRoundoff * whole.length * fraction / distance + rounding;
    if (!(shift <= settings_.largest_shift)) {
      const WideCut cut = wideCut(view_, polygon_, receiver_, starts_above ? start : end, starts_above ? end : start);
      fraction = static_cast<double>(cut.fraction);
      position = narrow<double>(cut.position);
      distance = norm(position);
      cut_error = 8.0;
      rounding = kUnitRoundoff;
      // A cut in doubled precision is right to 16 u^2 of the distances of its edge's ends.
      constexpr double kNearestCut = 0x1p-44;
      if (!(distance > kNearestCut)) {
        is_lost_ = true;
        return;
      }
      shift = rounding;
    }
    const PlainEnd<double> cut{position, 1.0 / distance, 0.0, 0.0};
    const Vector3<double> part = whole.edge * fraction;
    cut_angle_error_ += rounding;
    cut_hessian_error_ += 2.0 * shift * cut.inverse_distance * cut.inverse_distance;
    PlainEdge<double> visible{a, b, part, whole.length * fraction, whole.moment * fraction, whole.area * fraction};
    (starts_above ? visible.last : visible.first) = cut;
    // The cut's rounding turns the arc's plane and counts like the moment's.
    add(visible, moment_error, cut_error + kMomentToCutArc * rounding / kUnitRoundoff);
    if (starts_above) {
      last_cut_ = {position, shift};
    } else if (is_below_) {
      addHorizon(last_cut_, {position, shift});
    } else {
      first_cut_ = {position, shift};
    }
    is_below_ = starts_above;
  }

  /// A cut and how far it may be moved along its edge, relative to its distance.
  struct PlacedCut {
    Vector3<double> position;
    double shift;
  };

  /// The horizon's edge between two cuts. Cuts that are moved along their edges change irradiance to second order only:
  /// the arcs end where the horizon's edge begins, and what lies between that and the horizon has no weight.
  void addHorizon(const PlacedCut& from, const PlacedCut& to) {
    const Vector3<double> turn = cross<double>(from.position, to.position);
    const double turn_size = norm(turn);
    const double cosine_product = dot(from.position, to.position);
    const double angle = norm(receiver_.normal) * std::atan2(turn_size, cosine_product);
    horizon_ += dot(receiver_.normal, turn) < 0.0 ? -angle : angle;
    horizon_size_ += angle;
    const double moved = from.shift + to.shift;
    const double sine = turn_size / std::hypot(turn_size, cosine_product);
    const double tilt = moved / sine;
    cut_angle_error_ += 6.0 * kUnitRoundoff + 4.0 * moved * moved + angle * (tilt < 1.0 ? tilt * tilt : 2.0);
  }

  PlainResult summed() const {
    PlainResult result;
    result.vector_irradiance = 0.5 * sums_.angle_vector;
    result.irradiance = dot(receiver_.normal, result.vector_irradiance) + 0.5 * horizon_;
    result.gradient = sums_.gradient;
    result.hessian = 0.5 * (sums_.hessian + sums_.hessian.transpose());
    // Every arc rounds the partial sums once more.
    const auto arcs = static_cast<double>(sums_.arcs);
    const double angle_error =
        0.5 *
        (kUnitRoundoff * (sums_.angle_error + arcs * sums_.angle_size + (kPlainAngleError + arcs) * horizon_size_) +
         cut_angle_error_);
    result.bounds.irradiance = angle_error;
    result.bounds.rotational_gradient = angle_error;
    result.bounds.gradient = kUnitRoundoff * (sums_.gradient_error + arcs * sums_.gradient_size);
    result.bounds.hessian = kUnitRoundoff * (sums_.hessian_error + arcs * sums_.hessian_size) + cut_hessian_error_;
    // A polygon of more than that is integrated along its boundary by evaluatePolygon too.
    constexpr double kSurelyLarge = 1.1 * kSmallSourceExtent;
    if (extent_ > kSurelyLarge * kSurelyLarge * origin_.squaredNorm()) {
      constexpr double kLess = 0.9 * kUnitRoundoff;
      result.least_bounds.irradiance = kLess * kAngleError * 0.5 * sums_.angle_size;
      result.least_bounds.gradient = kLess * kArcError * sums_.gradient_size;
      result.least_bounds.hessian = kLess * kArcError * sums_.hessian_size;
    }
    return result;
  }

  const PlainView& view_;
  const Polygon& polygon_;
  const Receiver& receiver_;
  const PlainBoundarySettings& settings_;
  PlainSums<double> sums_;
  double horizon_ = 0.0;
  double horizon_size_ = 0.0;
  double cut_angle_error_ = 0.0;
  double cut_hessian_error_ = 0.0;
  PlacedCut first_cut_{};
  PlacedCut last_cut_{};
  bool is_below_ = false;  ///< after a cut downwards: the horizon's edge from last_cut_ is open
  Vector3<double> origin_ = Vector3<double>::Zero();  ///< where the first arc starts
  double extent_ = 0.0;                               ///< square of the largest distance of an arc's end from there
  bool is_lost_ = false;
};

}  // namespace

PlainResult withoutBounds() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PlainResult result;
  result.bounds = {kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};
  return result;
}

PlainResult plainBoundary(const PlainView& view, const Polygon& polygon, const Receiver& receiver,
                          const PlainBoundarySettings& settings) {
  if (view.horizon == PlainView::Horizon::kCrosses && !isOffPlane(view, polygon, receiver)) {
    return withoutBounds();
  }
  return BoundarySum(view, polygon, receiver, settings).result();
}

}  // namespace irradiff
