// The count of rounding errors of the plain boundary rule by machine: its own template at a scalar that carries every
// rounding, docs/derivations/rule_choice.md, section 2.

#include "derivatives/form_factor/plain_boundary.h"
#include "tests/boundary/edge_views.h"
#include "tests/boundary/tracked_scalar.h"
#include "verification/checks/input_families.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <optional>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;
/// The coefficients of the moments' series, which are constants of the program, are rounded themselves.
constexpr double kSeriesCoefficients = 1.0;

/// Worst-case errors in units of u relative to the sizes.
struct ErrorCount {
  double irradiance = 0.0;
  double gradient = 0.0;
  double hessian = 0.0;

  void include(const ErrorCount& other) {
    irradiance = std::max(irradiance, other.irradiance);
    gradient = std::max(gradient, other.gradient);
    hessian = std::max(hessian, other.hessian);
  }
};

using WideVector = Eigen::Matrix<long double, 3, 1>;

/// Components right to a rounding each, and off by `units` u of the length in any direction.
Vector3<Tracked> rounded(const WideVector& v, double units = 0.0) {
  const long double length = v.norm();
  Vector3<Tracked> result;
  for (int k = 0; k < 3; ++k) {
    const Tracked error = Tracked::input(1.0L, units) - Tracked::input(1.0L);
    result(k) = Tracked::input(v(k), 1.0) + Tracked::input(length) * error;
  }
  return result;
}

PlainEnd<Tracked> endOf(const WideVector& position, double height) {
  PlainEnd<Tracked> end;
  end.position = rounded(position);
  end.inverse_distance = Tracked(1.0) / norm(end.position);
  end.height = height == 0.0 ? Tracked(0.0) : Tracked::input(height, 1.0);
  end.cosine = end.height * end.inverse_distance;
  return end;
}

PlainSums<Tracked> sumsOf(const EdgeView& view, double moment_units) {
  const WideVector start = view.start.cast<long double>();
  const WideVector end = view.end.cast<long double>();
  PlainEdge<Tracked> edge;
  edge.first = endOf(start, view.start_height);
  edge.last = endOf(end, view.end_height);
  edge.edge = rounded(end - start);
  edge.length = norm(edge.edge);
  edge.moment = rounded(start.cross(end), moment_units);
  edge.area = norm(edge.moment);
  Vector3<Tracked> normal;
  for (int k = 0; k < 3; ++k) normal(k) = Tracked::input(view.normal(k));
  PlainSums<Tracked> sums;
  addPlainEdge(edge, {0.0, 0.0, 0.0}, seriesLengthsFor(0x1p-54L), normal, sums);
  return sums;
}

ErrorCount countOf(const PlainSums<Tracked>& sums, const Vector3<double>& normal) {
  ErrorCount count;
  Vector3<Tracked> exact_normal;
  for (int k = 0; k < 3; ++k) exact_normal(k) = Tracked::input(normal(k));
  count.irradiance = dot(exact_normal, sums.angle_vector).worstError() / static_cast<double>(sums.angle_size.value());
  for (int i = 0; i < 3; ++i) {
    count.gradient = std::max(count.gradient, sums.gradient(i).worstError());
    for (int j = 0; j <= i; ++j) {
      const Tracked entry = Tracked(0.5) * (sums.hessian(i, j) + sums.hessian(j, i));
      count.hessian = std::max(count.hessian, entry.worstError());
    }
  }
  count.gradient /= static_cast<double>(sums.gradient_size.value());
  count.hessian /= static_cast<double>(sums.hessian_size.value());
  return count;
}

struct ArcCounts {
  ErrorCount whole, cut;
};

ArcCounts countRandomArcs(double moment_units) {
  ArcCounts worst;
  for (std::size_t i = 0; i < lengthened(10000); ++i) {
    KeyedRandom random(kSeed, "arcs", i);
    const std::optional<EdgeView> view = edgeView(drawEdgeParameters(random));
    if (!view) continue;
    const ErrorTape tape;
    const PlainSums<Tracked> sums = sumsOf(*view, moment_units);
    (view->angle > kLongestArc ? worst.cut : worst.whole).include(countOf(sums, view->normal));
  }
  return worst;
}

void print(const char* what, const ErrorCount& count) {
  std::cout << what << ", seed " << kSeed << ": irradiance " << count.irradiance << ", gradient " << count.gradient
            << ", Hessian " << count.hessian << " u\n";
}

TEST(PlainBoundaryCount, OfRandomArcsIsBelowTheConstants) {
  const ArcCounts worst = countRandomArcs(0.0);
  print("arcs up to 2 rad", worst.whole);
  print("arcs cut at the foot", worst.cut);
  for (const ErrorCount& count : {worst.whole, worst.cut}) {
    EXPECT_LE(count.irradiance, kPlainAngleError);
    EXPECT_LE(count.gradient + kSeriesCoefficients, kPlainArcError);
    EXPECT_LE(count.hessian + kSeriesCoefficients, kPlainArcError);
  }
}

// What an error of r x e adds: a large one, so that the other errors are small beside it.
TEST(PlainBoundaryCount, ErrorsOfTheMomentEnterAsTheConstantsSay) {
  constexpr double kUnits = 1e6;
  // Each component is off by as much, so the vector may be by sqrt(3) times that.
  const double units = std::sqrt(3.0) * kUnits;
  const ArcCounts worst = countRandomArcs(kUnits);
  print("arcs up to 2 rad, a millionth of it",
        {worst.whole.irradiance / kUnits, worst.whole.gradient / kUnits, worst.whole.hessian / kUnits});
  print("arcs cut at the foot, a millionth of it",
        {worst.cut.irradiance / kUnits, worst.cut.gradient / kUnits, worst.cut.hessian / kUnits});
  EXPECT_LE(worst.whole.irradiance, kMomentToAngle * units + kPlainAngleError);
  EXPECT_LE(worst.whole.gradient, kMomentToArc * units + kPlainArcError);
  EXPECT_LE(worst.whole.hessian, kMomentToArc * units + kPlainArcError);
  EXPECT_LE(worst.cut.irradiance, kMomentToAngle * units + kPlainAngleError);
  EXPECT_LE(worst.cut.gradient, kMomentToCutArc * units + kPlainArcError);
  EXPECT_LE(worst.cut.hessian, kMomentToCutArc * units + kPlainArcError);
  // It can fail: they do enter.
  EXPECT_GT(worst.whole.hessian, 0.5 * kUnits);
}

}  // namespace
}  // namespace irradiff
