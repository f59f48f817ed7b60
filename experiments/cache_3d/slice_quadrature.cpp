#include "experiments/cache_3d/slice_quadrature.h"

#include "derivatives/boundary/gauss_legendre.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace irradiff {

namespace {

thread_local std::size_t slice_count = 0;

constexpr std::size_t kElevationNodes = 3;
/// Panels are halved at most so often: 2^-24 of a panel is narrower than any pixel's distance from a wall asks for.
constexpr int kMostHalvings = 24;

/// Gauss-Legendre with 3 nodes inside Kronrod's with 7, on [-1, 1]: the middle, then pairs outwards (QUADPACK's
/// construction; Kronrod 1965). Exact for degree 5 and 11.
constexpr std::array<double, 4> kKronrodNodes{0.0, 0.434243749346802558, 0.774596669241483377, 0.960491268708020283};
constexpr std::array<double, 4> kKronrodWeights{0.450916538658474142, 0.401397414775962223, 0.268488089868333441,
                                                0.104656226026467265};
constexpr double kGaussMiddle = 8.0 / 9.0;
constexpr double kGaussPair = 5.0 / 9.0;

/// The integral of L cos sin over the elevation in the half-planes of one view.
class SliceIntegrand {
 public:
  SliceIntegrand(const SliceView& view, const SliceSteps& steps) : view_(&view), steps_(steps) {}

  double operator()(double azimuth) {
    ++slice_count;
    view_->cut(azimuth, segments_);
    findVisibleParts(segments_, parts_);
    const Eigen::Vector2d along(std::cos(azimuth), std::sin(azimuth));
    double sum = 0.0;
    for (const VisiblePart& part : parts_) sum += partIntegral(part, along);
    return sum;
  }

 private:
  // With p = (s, h) on the segment, from p0 along d, u = s^2/|p|^2 and half the integral of L du is that of
  //   L s h |h0 ds - s0 dh|/|p|^4   over the parameter along the segment.
  double partIntegral(const VisiblePart& part, const Eigen::Vector2d& along) const {
    const SliceSegment& segment = segments_[part.segment];
    const SurfaceView& surface = view_->faces()[segment.face].radiance;
    if (surface.grid->values.empty()) return 0.0;
    const Eigen::Vector2d first_direction = sliceDirection(part.begin);
    const Eigen::Vector2d last_direction = sliceDirection(part.end);
    const Eigen::Vector2d first = first_direction / segment.inverse.dot(first_direction);
    const Eigen::Vector2d last = last_direction / segment.inverse.dot(last_direction);
    const Eigen::Vector2d d = last - first;
    const double turn = std::abs(first[1] * d[0] - first[0] * d[1]);
    const Eigen::Vector2d across(along.dot(surface.across.head<2>()), surface.across.z());
    const Eigen::Vector2d down(along.dot(surface.along.head<2>()), surface.along.z());
    const double first_column = surface.first_column + across.dot(first);
    const double first_row = surface.first_row + down.dot(first);
    const double columns = across.dot(d);
    const double rows = down.dot(d);
    const double longest_step = steps_.cells / std::max(std::max(std::abs(columns), std::abs(rows)), 1e-300);
    const double length = d.norm();
    const double step_per_distance = steps_.distances / (1.0 + steps_.distances) / length;
    const GaussLegendreRule& rule = gaussLegendre(kElevationNodes);
    double sum = 0.0;
    double begin = 0.0;
    while (begin < 1.0) {
      const double distance = (first + begin * d).norm();
      double step = std::min(longest_step, step_per_distance * distance);
      // No sliver at the end.
      const double left = 1.0 - begin;
      if (step >= left) {
        step = left;
      } else if (2.0 * step > left) {
        step = 0.5 * left;
      }
      for (std::size_t k = 0; k < kElevationNodes; ++k) {
        const double place = begin + rule.nodes[k] * step;
        const double s = first[0] + place * d[0];
        const double h = first[1] + place * d[1];
        const double square = s * s + h * h;
        sum += rule.weights[k] * step * turn * s * h / (square * square) *
               surface.grid->at(first_column + place * columns, first_row + place * rows);
      }
      begin = step == left ? 1.0 : begin + step;
    }
    return sum;
  }

  const SliceView* view_;
  SliceSteps steps_;
  std::vector<SliceSegment> segments_;
  std::vector<VisiblePart> parts_;
};

struct Panel {
  double begin;
  double end;
  double value;
  double difference;  ///< of the two rules
};

Panel panelOf(SliceIntegrand& integrand, double begin, double end) {
  const double middle = 0.5 * (begin + end);
  const double half = 0.5 * (end - begin);
  const double centre = integrand(middle);
  double kronrod = kKronrodWeights[0] * centre;
  double gauss = kGaussMiddle * centre;
  for (std::size_t k = 1; k < kKronrodNodes.size(); ++k) {
    const double pair = integrand(middle - kKronrodNodes[k] * half) + integrand(middle + kKronrodNodes[k] * half);
    kronrod += kKronrodWeights[k] * pair;
    if (k == 2) gauss += kGaussPair * pair;
  }
  return {begin, end, half * kronrod, half * std::abs(kronrod - gauss)};
}

double refined(SliceIntegrand& integrand, const Panel& panel, double largest_difference, int halvings) {
  if (panel.difference <= largest_difference || halvings == kMostHalvings) return panel.value;
  const double middle = 0.5 * (panel.begin + panel.end);
  return refined(integrand, panelOf(integrand, panel.begin, middle), largest_difference, halvings + 1) +
         refined(integrand, panelOf(integrand, middle, panel.end), largest_difference, halvings + 1);
}

}  // namespace

SliceQuadrature::SliceQuadrature(std::span<const Polygon> polygons, const SurfaceRadiance& radiance,
                                 const SliceSteps& steps)
    : polygons_(polygons.begin(), polygons.end()), radiance_(&radiance), outline_(polygons), steps_(steps) {}

std::size_t SliceQuadrature::lastSliceCount() { return slice_count; }

double SliceQuadrature::irradiance(const Receiver& receiver) const {
  slice_count = 0;
  const SliceView view(polygons_, *radiance_, receiver);
  SliceIntegrand integrand(view, steps_);
  std::vector<double> breaks = view.breaks(outline_);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (breaks.empty()) breaks.push_back(0.0);
  breaks.push_back(breaks.front() + kTurn);
  std::vector<Panel> panels;
  double irradiance = 0.0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double width = breaks[i + 1] - breaks[i];
    const double count = std::max(1.0, std::ceil(width / steps_.azimuth));
    for (double k = 0.0; k < count; k += 1.0) {
      panels.push_back(panelOf(integrand, breaks[i] + k / count * width, breaks[i] + (k + 1.0) / count * width));
      irradiance += panels.back().value;
    }
  }
  const double largest_difference = steps_.tolerance * irradiance;
  double sum = 0.0;
  for (const Panel& panel : panels) sum += refined(integrand, panel, largest_difference, 0);
  return sum;
}

}  // namespace irradiff
