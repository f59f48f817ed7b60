#include "experiments/cache_3d/slice_quadrature.h"

#include "derivatives/boundary/gauss_legendre.h"
#include "derivatives/boundary/irradiance.h"
#include "derivatives/scene/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

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

/// Beside an edge along the normal, rad: on which side a half-plane is, is beyond doubt, and nothing else has changed.
constexpr double kBesideEdge = 1e-7;

/// Where a place that moves from `first` by `travel` while a parameter goes from 0 to 1 passes the nodes of a grid: the
/// inner ones, since the first and the last cell go on beyond the grid.
class CellBorders {
 public:
  CellBorders(double first, double travel, std::size_t nodes)
      : first_(first),
        inverse_travel_(travel == 0.0 ? 0.0 : 1.0 / travel),
        step_(travel > 0.0 ? 1.0 : -1.0),
        lowest_(1.0),
        highest_(static_cast<double>(nodes) - 2.0),
        next_(travel > 0.0 ? std::max(lowest_, std::ceil(first)) : std::min(highest_, std::floor(first))) {}

  /// The first one that is more than kShortestStep behind a parameter; infinite if there is none. Parameters must
  /// ascend from call to call.
  double after(double parameter) {
    if (inverse_travel_ == 0.0) return std::numeric_limits<double>::infinity();
    for (; next_ >= lowest_ && next_ <= highest_; next_ += step_) {
      const double border = (next_ - first_) * inverse_travel_;
      if (border > parameter + kShortestStep) return border;
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr double kShortestStep = 1e-9;

  double first_, inverse_travel_, step_, lowest_, highest_, next_;
};

/// Irradiance, and its derivatives along t and b.
using Values = Eigen::Array3d;

/// The integral of L cos sin over the elevation in the half-planes of one view, and its derivatives.
class SliceIntegrand {
 public:
  SliceIntegrand(const SliceView& view, const SliceSteps& steps) : view_(&view), steps_(steps) {}

  Values operator()(double azimuth) {
    ++slice_count;
    view_->cut(azimuth, segments_);
    findVisibleParts(segments_, parts_);
    const Eigen::Vector2d along(std::cos(azimuth), std::sin(azimuth));
    Values sum = Values::Zero();
    for (const VisiblePart& part : parts_) sum += partIntegral(part, along);
    return sum;
  }

 private:
  // With p = (s, h) on the segment, from p0 along d, u = s^2/|p|^2 and half the integral of L du is that of
  //   L s h |h0 ds - s0 dh|/|p|^4   over the parameter along the segment.
  // A direction that meets the plane q.p = 1 at p meets it at p + dx - p (q.dx) when the receiver has moved by dx.
  Values partIntegral(const VisiblePart& part, const Eigen::Vector2d& along) const {
    const SliceSegment& segment = segments_[part.segment];
    const SurfaceView& surface = view_->faces()[segment.face].radiance;
    if (surface.grid->values.empty()) return Values::Zero();
    const Eigen::Vector2d first_direction = sliceDirection(part.begin.u);
    const Eigen::Vector2d last_direction = sliceDirection(part.end.u);
    const Eigen::Vector2d first = first_direction / segment.inverse.dot(first_direction);
    const Eigen::Vector2d last = last_direction / segment.inverse.dot(last_direction);
    const Eigen::Vector2d d = last - first;
    const double turn = std::abs(first[1] * d[0] - first[0] * d[1]);
    const Eigen::Vector2d across(along.dot(surface.across.head<2>()), surface.across.z());
    const Eigen::Vector2d down(along.dot(surface.along.head<2>()), surface.along.z());
    const double column_offset = across.dot(first);
    const double row_offset = down.dot(first);
    const double columns = across.dot(d);
    const double rows = down.dot(d);
    const double step_per_distance = steps_.distances / (1.0 + steps_.distances) / d.norm();
    const GaussLegendreRule& rule = gaussLegendre(kElevationNodes);
    double sum = 0.0;
    // Of slope per column and per row, and of the place in columns and rows times it.
    double column_sum = 0.0;
    double row_sum = 0.0;
    double plane_sum = 0.0;
    CellBorders column_borders(surface.first_column + column_offset, columns, surface.grid->columns);
    CellBorders row_borders(surface.first_row + row_offset, rows, surface.grid->rows);
    double begin = 0.0;
    while (begin < 1.0) {
      const double distance = (first + begin * d).norm();
      double end = std::min(1.0, begin + step_per_distance * distance);
      end = std::min({end, column_borders.after(begin), row_borders.after(begin)});
      const double step = end - begin;
      for (std::size_t k = 0; k < kElevationNodes; ++k) {
        const double place = begin + rule.nodes[k] * step;
        const double s = first[0] + place * d[0];
        const double h = first[1] + place * d[1];
        const double square = s * s + h * h;
        const double weight = rule.weights[k] * step * turn * s * h / (square * square);
        const double column = column_offset + place * columns;
        const double row = row_offset + place * rows;
        const RadianceGrid::Slope slope = surface.grid->slopeAt(surface.first_column + column, surface.first_row + row);
        sum += weight * slope.value;
        column_sum += weight * slope.per_column;
        row_sum += weight * slope.per_row;
        plane_sum += weight * (slope.per_column * column + slope.per_row * row);
      }
      begin = end;
    }
    const double first_radiance =
        surface.grid->at(surface.first_column + column_offset, surface.first_row + row_offset);
    const double last_radiance =
        surface.grid->at(surface.first_column + column_offset + columns, surface.first_row + row_offset + rows);
    const Eigen::Vector2d gradient = column_sum * surface.across.head<2>() + row_sum * surface.along.head<2>() -
                                     plane_sum * segment.plane +
                                     0.5 * (last_radiance * part.end.motion - first_radiance * part.begin.motion);
    return {sum, gradient[0], gradient[1]};
  }

  const SliceView* view_;
  SliceSteps steps_;
  std::vector<SliceSegment> segments_;
  std::vector<VisiblePart> parts_;
};

struct Panel {
  double begin;
  double end;
  Values value;
  Values difference;  ///< of the two rules, its size
};

Panel panelOf(SliceIntegrand& integrand, double begin, double end) {
  const double middle = 0.5 * (begin + end);
  const double half = 0.5 * (end - begin);
  const Values centre = integrand(middle);
  Values kronrod = kKronrodWeights[0] * centre;
  Values gauss = kGaussMiddle * centre;
  for (std::size_t k = 1; k < kKronrodNodes.size(); ++k) {
    const Values pair = integrand(middle - kKronrodNodes[k] * half) + integrand(middle + kKronrodNodes[k] * half);
    kronrod += kKronrodWeights[k] * pair;
    if (k == 2) gauss += kGaussPair * pair;
  }
  return {begin, end, half * kronrod, half * (kronrod - gauss).abs()};
}

Values refined(SliceIntegrand& integrand, const Panel& panel, const Values& largest_difference, int halvings) {
  if ((panel.difference <= largest_difference).all() || halvings == kMostHalvings) return panel.value;
  const double middle = 0.5 * (panel.begin + panel.end);
  return refined(integrand, panelOf(integrand, panel.begin, middle), largest_difference, halvings + 1) +
         refined(integrand, panelOf(integrand, middle, panel.end), largest_difference, halvings + 1);
}

/// What the motion of the jumps at steep edges adds to the gradient.
Eigen::Vector2d jumpGradient(SliceIntegrand& integrand, const std::vector<SliceView::SteepEdge>& edges) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const SliceView::SteepEdge& edge : edges) {
    const double jump = integrand(edge.azimuth - kBesideEdge)[0] - integrand(edge.azimuth + kBesideEdge)[0];
    sum -= jump / edge.distance * Eigen::Vector2d(-std::sin(edge.azimuth), std::cos(edge.azimuth));
  }
  return sum;
}

double extentOf(const SceneOutline& outline) {
  double extent = 0.0;
  for (const Eigen::Vector3d& vertex : outline.vertices) {
    extent = std::max(extent, (vertex - outline.vertices.front()).lpNorm<Eigen::Infinity>());
  }
  return extent;
}

/// Edges that are one line as seen in azimuth, once.
std::vector<SliceView::SteepEdge> distinct(std::vector<SliceView::SteepEdge> edges) {
  std::ranges::sort(edges, {}, &SliceView::SteepEdge::azimuth);
  const auto same = [](const SliceView::SteepEdge& a, const SliceView::SteepEdge& b) {
    return b.azimuth - a.azimuth < kBesideEdge;
  };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  return edges;
}

}  // namespace

SliceQuadrature::SliceQuadrature(std::span<const Polygon> polygons, const SurfaceRadiance& radiance,
                                 const SliceSteps& steps)
    : polygons_(polygons.begin(), polygons.end()),
      radiance_(&radiance),
      outline_(polygons),
      extent_(extentOf(outline_)),
      steps_(steps) {}

std::size_t SliceQuadrature::lastSliceCount() { return slice_count; }

SliceIrradiance SliceQuadrature::at(const Receiver& receiver) const {
  slice_count = 0;
  const SliceView view(polygons_, *radiance_, receiver);
  SliceIntegrand integrand(view, steps_);
  std::vector<double> breaks = view.breaks(outline_);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (breaks.empty()) breaks.push_back(0.0);
  breaks.push_back(breaks.front() + kTurn);
  std::vector<Panel> panels;
  double irradiance = 0.0;
  Values differences = Values::Zero();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double width = breaks[i + 1] - breaks[i];
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(width / steps_.azimuth)));
    const double panel = width / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k) {
      const double begin = breaks[i] + static_cast<double>(k) * panel;
      panels.push_back(panelOf(integrand, begin, k + 1 == count ? breaks[i + 1] : begin + panel));
      irradiance += panels.back().value[0];
      differences += panels.back().difference;
    }
  }
  // What is not a number never meets a tolerance: halving panels would not end.
  if (!differences.allFinite()) {
    throw std::invalid_argument(
        "irradiance by slices at the receiver at " + pointText(receiver.position) +
        ": is not a number, must be: squares of lengths, or the radiance, leave the range of double");
  }
  Values largest_difference = Values::Constant(steps_.tolerance * irradiance);
  largest_difference.tail<2>() /= steps_.gradient_length * extent_;
  Values sum = Values::Zero();
  for (const Panel& panel : panels) sum += refined(integrand, panel, largest_difference, 0);
  const Eigen::Vector2d gradient =
      sum.tail<2>().matrix() + jumpGradient(integrand, distinct(view.steepEdges(outline_)));
  return {sum[0], tangentFrame<double>(receiver.normal) * gradient};
}

}  // namespace irradiff
