// Each simplification of the production path against the general path that it saves: no result changes by more than
// both bounds together. Where the same is done without its condition, results do change by more.

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/gauss_legendre.h"
#include "derivatives/boundary/small_source.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/form_factor/prepared_polygon.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/certified/certified_polygon.h"
#include "verification/checks/input_families.h"
#include "verification/occlusion/scene_families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20121106;

using Shares = std::array<double, 5>;

/// Differences of the five quantities in units of both bounds together; 0 where they are equal.
Shares sharesOf(const IrradianceDerivatives<double>& a, const DerivativeBounds& a_bounds,
                const IrradianceDerivatives<double>& b, const DerivativeBounds& b_bounds) {
  const auto share = [](double difference, double bounds) { return difference == 0.0 ? 0.0 : difference / bounds; };
  const auto largest = [](const auto& x, const auto& y) { return (x.value - y.value).cwiseAbs().maxCoeff(); };
  return {share(std::abs(a.irradiance.value - b.irradiance.value), a_bounds.irradiance + b_bounds.irradiance),
          share(largest(a.gradient, b.gradient), a_bounds.gradient + b_bounds.gradient),
          share(largest(a.hessian, b.hessian), a_bounds.hessian + b_bounds.hessian),
          share(largest(a.tangential_hessian, b.tangential_hessian),
                a_bounds.tangential_hessian + b_bounds.tangential_hessian),
          share(largest(a.rotational_gradient, b.rotational_gradient),
                a_bounds.rotational_gradient + b_bounds.rotational_gradient)};
}

/// Of a scene, those quantities that exist both times.
Shares sharesOf(const SceneEvaluation<3>& a, const SceneEvaluation<3>& b) {
  Shares shares = sharesOf(a.derivatives, a.bounds, b.derivatives, b.bounds);
  if (!a.no_gradient.empty() || !b.no_gradient.empty()) shares[1] = 0.0;
  if (!a.no_hessian.empty() || !b.no_hessian.empty()) shares[2] = 0.0;
  if (!a.no_tangential_hessian.empty() || !b.no_tangential_hessian.empty()) shares[3] = 0.0;
  return shares;
}

double largestOf(const Shares& shares) { return *std::ranges::max_element(shares); }

/// What was compared, and the worst of it.
class Comparison {
 public:
  explicit Comparison(std::string what) : what_(std::move(what)) {}

  void add(const Shares& shares, const std::string& line) {
    ++count_;
    for (std::size_t i = 0; i < shares.size(); ++i) worst_[i] = std::max(worst_[i], shares[i]);
    const double largest = largestOf(shares);
    if (largest > 1.0) {
      ++beyond_;
      if (first_.empty()) first_ = line;
    }
  }

  std::size_t count() const { return count_; }
  /// In which some quantity differs by more than the bounds.
  std::size_t beyond() const { return beyond_; }

  void expectWithin(std::size_t least_count) const {
    print();
    EXPECT_GE(count_, least_count) << what_;
    EXPECT_EQ(beyond_, 0U) << what_ << ": " << first_;
  }
  void expectBeyondInMost() const {
    print();
    EXPECT_GE(beyond_, (count_ + 1) / 2) << what_;
    EXPECT_GE(count_, 1U) << what_;
  }

 private:
  void print() const {
    std::cout << what_ << ": " << count_ << " compared, difference over both bounds at most";
    for (const double share : worst_) std::cout << ' ' << share;
    std::cout << ", beyond them in " << beyond_ << '\n';
  }

  std::string what_;
  std::size_t count_ = 0;
  std::size_t beyond_ = 0;
  Shares worst_{};
  std::string first_;
};

/// Calls take(scene, evaluator) for scenes of all families.
template <class Take>
void forAllScenes(std::size_t count, const Take& take) {
  for (const SceneFamily& family : sceneFamilies()) {
    for (std::size_t k = 0; k < count; ++k) {
      const OccludedScene scene = drawScene(family, kSeed, k);
      take(scene, SceneEvaluator(scene.polygons));
    }
  }
}

/// All that radiates and is seen as if it were partly hidden: summed over the boundary of the whole view.
SceneComposition general(const SceneEvaluator& evaluator, const Receiver& receiver) {
  SceneComposition scene = evaluator.compose(receiver);
  for (const std::size_t i : scene.whole) scene.partly_hidden[i] = evaluator.polygons()[i].radiance;
  scene.whole.clear();
  scene.view = evaluator.view(receiver);
  return scene;
}

SceneEvaluation<3> evaluate(const SceneEvaluator& evaluator, const Receiver& receiver, const SceneComposition& scene) {
  return evaluator.evaluate(receiver, scene, ApparentVertices::kMove);
}

TEST(Simplifications, NoVisibilityForAPolygonAlone) {
  Comparison comparison("a polygon alone, without a view");
  for (const InputFamily& family : inputFamilies()) {
    for (const Configuration& c : drawInputs(family, lengthened(60), kSeed)) {
      try {
        const SceneEvaluator evaluator(std::vector<Polygon>{c.polygon});
        if (evaluator.compose(c.receiver).whole.empty()) continue;
        comparison.add(
            sharesOf(evaluator.evaluate(c.receiver), evaluate(evaluator, c.receiver, general(evaluator, c.receiver))),
            sceneLine(c));
      } catch (const InvalidScene&) {
        continue;
      }
    }
  }
  comparison.expectWithin(lengthened(600));
  // Where something may hide it, it does not do without.
  Comparison twin("twin: polygons that others hide, without a view");
  forAllScenes(lengthened(20), [&](const OccludedScene& scene, const SceneEvaluator& evaluator) {
    const SceneEvaluation<3> right = evaluator.evaluate(scene.receiver);
    if (right.sources->partly_hidden == 0) return;
    SceneComposition blind = evaluator.compose(scene.receiver);
    for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
      if (blind.partly_hidden[i] > 0.0) blind.whole.push_back(i);
      blind.partly_hidden[i] = 0.0;
    }
    twin.add(sharesOf(right, evaluate(evaluator, scene.receiver, blind)), sceneLine(scene));
  });
  twin.expectBeyondInMost();
}

TEST(Simplifications, APolygonThatIsSeenWholeAsIfAlone) {
  Comparison comparison("polygons seen whole, as if alone");
  forAllScenes(lengthened(60), [&](const OccludedScene& scene, const SceneEvaluator& evaluator) {
    const SceneComposition composition = evaluator.compose(scene.receiver);
    if (composition.whole.empty() || composition.view.is_seen.empty()) return;
    comparison.add(sharesOf(evaluate(evaluator, scene.receiver, composition),
                            evaluate(evaluator, scene.receiver, general(evaluator, scene.receiver))),
                   sceneLine(scene));
  });
  comparison.expectWithin(lengthened(300));
}

TEST(Simplifications, HiddenPolygonsAreSkipped) {
  Comparison comparison("scenes without their hidden polygons");
  Comparison twin("twin: scenes without one polygon that is seen in part");
  forAllScenes(lengthened(60), [&](const OccludedScene& scene, const SceneEvaluator& evaluator) {
    const SceneEvaluation<3> all = evaluator.evaluate(scene.receiver);
    const SceneComposition composition = evaluator.compose(scene.receiver);
    if (composition.view.is_seen.empty()) return;
    std::vector<Polygon> seen;
    for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
      if (composition.view.is_seen[i]) seen.push_back(scene.polygons[i]);
    }
    if (seen.size() < scene.polygons.size() && all.sources->edge_on == 0) {
      comparison.add(sharesOf(all, SceneEvaluator(seen).evaluate(scene.receiver)), sceneLine(scene));
    }
    if (const std::optional<std::size_t> partly = composition.firstPartlyHidden()) {
      std::vector<Polygon> fewer = scene.polygons;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(*partly));
      twin.add(sharesOf(all, SceneEvaluator(fewer).evaluate(scene.receiver)), sceneLine(scene));
    }
  });
  comparison.expectWithin(lengthened(100));
  twin.expectBeyondInMost();
}

TEST(Simplifications, BlackPolygonsAreSkipped) {
  Comparison comparison("black polygons, without integrating them");
  Comparison twin("twin: without black polygons that hide");
  forAllScenes(lengthened(60), [&](const OccludedScene& scene, const SceneEvaluator& evaluator) {
    const SceneEvaluation<3> right = evaluator.evaluate(scene.receiver);
    if (right.sources->black == 0) return;
    SceneComposition with_black = evaluator.compose(scene.receiver);
    if (with_black.view.is_seen.empty()) return;
    std::vector<Polygon> lit;
    bool hides = false;
    for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
      if (scene.polygons[i].radiance > 0.0) {
        lit.push_back(scene.polygons[i]);
        hides = hides || with_black.partly_hidden[i] > 0.0;
      } else if (with_black.view.is_seen[i]) {
        with_black.whole.push_back(i);
      }
    }
    comparison.add(sharesOf(right, evaluate(evaluator, scene.receiver, with_black)), sceneLine(scene));
    if (hides) twin.add(sharesOf(right, SceneEvaluator(lit).evaluate(scene.receiver)), sceneLine(scene));
  });
  comparison.expectWithin(lengthened(150));
  twin.expectBeyondInMost();
}

TEST(Simplifications, NoMotionWhereNoApparentVertexCounts) {
  Comparison comparison("without apparent vertices, where none counts");
  Comparison twin("twin: without apparent vertices, where some do");
  forAllScenes(lengthened(60), [&](const OccludedScene& scene, const SceneEvaluator& evaluator) {
    const SceneComposition composition = evaluator.compose(scene.receiver);
    if (!composition.dark.has_occlusion) return;
    const SceneEvaluation<3> moving = evaluate(evaluator, scene.receiver, composition);
    const SceneEvaluation<3> fixed = evaluator.evaluate(scene.receiver, composition, ApparentVertices::kFixed);
    (moving.apparent_vertices == 0 ? comparison : twin).add(sharesOf(moving, fixed), sceneLine(scene));
  });
  comparison.expectWithin(lengthened(50));
  twin.expectBeyondInMost();
}

/// A polygon with its vertices relative to the receiver, cut at the horizon by the loop that knows no shortcut
/// (Sutherland and Hodgman 1974), or not cut at all.
ClippedPolygon<double> cutLoop(const PreparedPolygon& prepared, const Receiver& receiver, bool is_cut) {
  using WideScalar = DoubleWord<double>;
  std::vector<ClippedVertex<double>> loop;
  for (const Vector3<double>& v : prepared.scaled.vertices) {
    loop.push_back({wideDifference<WideScalar>(v, prepared.scaled.position),
                    static_cast<double>(horizonHeight<WideScalar>(v, prepared.scaled.position, receiver.normal))});
  }
  ClippedPolygon<double> polygon;
  if (!is_cut) {
    // What is below counts as if it were above: no edge is taken for one of the horizon.
    for (ClippedVertex<double>& vertex : loop) vertex.height = std::abs(vertex.height);
    polygon.vertices = loop;
    return polygon;
  }
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const ClippedVertex<double>& a = loop[i];
    const ClippedVertex<double>& b = loop[(i + 1) % loop.size()];
    if (a.height >= 0.0) polygon.vertices.push_back(a);
    if ((a.height < 0.0) == (b.height < 0.0)) continue;
    polygon.crosses_horizon = true;
    const WideScalar fraction = WideScalar(a.height) / (WideScalar(a.height) - WideScalar(b.height));
    Vector3<WideScalar> crossing;
    for (int k = 0; k < 3; ++k) crossing(k) = a.position(k) + fraction * (b.position(k) - a.position(k));
    polygon.vertices.push_back({crossing, 0.0});
  }
  return polygon;
}

/// Irradiance alone, with the bound of its sum over edges.
struct BoundedIrradiance {
  double value;
  double bound;
};

BoundedIrradiance irradianceOf(const ClippedPolygon<double>& polygon, const Receiver& receiver) {
  const RadianceBoundary<double> boundary = polygonBoundary(polygon, receiver.normal);
  const BoundarySums<double> sums = boundarySums(boundary, receiver.normal);
  const auto arcs = static_cast<double>(polygon.vertices.size() + boundary.arcs.size());
  return {std::abs(sums.derivatives.irradiance.value), (kAngleError + arcs) * 0x1p-53 * sums.irradiance_size};
}

TEST(Simplifications, NoCutAboveTheHorizon) {
  Comparison comparison("polygons above the horizon, not cut");
  Comparison twin("twin: polygons that cross the horizon, not cut");
  for (const char* name : {"well-conditioned", "generic", "size", "horizon corner", "scale", "translated"}) {
    for (const Configuration& c : drawInputs(inputFamily(name), lengthened(100), kSeed)) {
      const PolygonEvaluation right = evaluatePolygon(c.polygon, 0, c.receiver);
      if (right.rule != PolygonRule::kBoundary) continue;
      const PreparedPolygon prepared = preparePolygon(c.polygon, 0, c.receiver);
      const BoundedIrradiance other = irradianceOf(cutLoop(prepared, c.receiver, !right.crosses_horizon), c.receiver);
      const double difference = std::abs(right.derivatives.irradiance.value - other.value);
      const Shares shares{difference == 0.0 ? 0.0 : difference / (right.bounds.irradiance + other.bound)};
      (right.crosses_horizon ? twin : comparison).add(shares, sceneLine(c));
    }
  }
  comparison.expectWithin(lengthened(200));
  twin.expectBeyondInMost();
}

/// The boundary form in double words with its proven bounds.
PolygonEvaluation byEdges(const Configuration& c) {
  return certifyPolygonAt(Rung::kExtended, c.polygon, 0, c.receiver, kDefaultTolerance).evaluation;
}

/// The area rule's quadrature on the triangles of a fan, whether the polygon is small or not, with the bound that it
/// claims for the largest extent that it is made for.
PolygonEvaluation byAreaRegardless(const Configuration& c) {
  const SmallSourceRule rule = smallSourceRule(kSmallSourceExtent);
  const Vector3<double>& n = c.receiver.normal;
  SmallSourceSums<3> sums;
  for (std::size_t i = 1; i + 1 < c.polygon.vertices.size(); ++i) {
    const Vector3<double> a = c.polygon.vertices[0] - c.receiver.position;
    const Vector3<double> b = c.polygon.vertices[i] - c.receiver.position;
    const Vector3<double> d = c.polygon.vertices[i + 1] - c.receiver.position;
    const Vector3<double> area = (b - a).cross(d - a);
    for (std::size_t j = 0; j < rule.rule->nodes.size(); ++j) {
      for (std::size_t k = 0; k < rule.rule->nodes.size(); ++k) {
        const double s = rule.rule->nodes[j];
        const double weight = rule.rule->weights[j] * rule.rule->weights[k] * s;
        const Vector3<double> p = a + s * ((b - a) + rule.rule->nodes[k] * (d - b));
        const SmallSourceSums<3>::InTangentPlane none{Vector2<double>::Zero(), 0.0};
        sums.add(p, none, n.dot(p), weight * area.dot(a), weight * area, none, weight * area.norm(), 0.0, n);
      }
    }
  }
  PolygonEvaluation evaluation = evaluatePolygon(c.polygon, 0, c.receiver);
  const double sign = sums.irradiance < 0.0 ? -1.0 : 1.0;
  const double relative = (kSmallSourceError + 1000.0) * 0x1p-53 + rule.truncation;
  evaluation.derivatives.irradiance.value = sign * sums.irradiance;
  evaluation.derivatives.gradient.value = sign * sums.gradient;
  evaluation.derivatives.hessian.value = sign * sums.hessian;
  evaluation.bounds.irradiance = relative * sums.irradiance_size;
  evaluation.bounds.gradient = relative * sums.gradient_size;
  evaluation.bounds.hessian = relative * sums.hessian_size;
  return evaluation;
}

TEST(Simplifications, TheAreaRuleForSmallPolygons) {
  Comparison comparison("area rule against edges");
  for (const InputFamily& family : inputFamilies()) {
    for (const Configuration& c : drawInputs(family, lengthened(60), kSeed)) {
      const PolygonEvaluation by_area = evaluatePolygon(c.polygon, 0, c.receiver);
      if (by_area.rule != PolygonRule::kArea) continue;
      const PolygonEvaluation by_edges = byEdges(c);
      comparison.add(sharesOf(by_area.derivatives, by_area.bounds, by_edges.derivatives, by_edges.bounds),
                     sceneLine(c));
    }
  }
  comparison.expectWithin(lengthened(60));
  Comparison twin("twin: the same quadrature for polygons larger than their distance");
  for (const Configuration& c : drawInputs(inputFamily("size"), lengthened(200), kSeed)) {
    const PolygonEvaluation right = evaluatePolygon(c.polygon, 0, c.receiver);
    const double distance = (c.polygon.vertices[0] - c.receiver.position).norm();
    const double size = (c.polygon.vertices[0] - c.polygon.vertices[1]).norm();
    if (right.crosses_horizon || right.rule != PolygonRule::kBoundary || size < distance) continue;
    const PolygonEvaluation by_area = byAreaRegardless(c);
    const PolygonEvaluation by_edges = byEdges(c);
    twin.add(sharesOf(by_area.derivatives, by_area.bounds, by_edges.derivatives, by_edges.bounds), sceneLine(c));
  }
  twin.expectBeyondInMost();
}

TEST(Simplifications, EachPolygonCountsOnce) {
  forAllScenes(lengthened(20), [&](const OccludedScene& scene, const SceneEvaluator& evaluator) {
    const SourceCounts c = evaluator.evaluate(scene.receiver).sources.value();
    EXPECT_EQ(
        c.own_surface + c.below_horizon + c.edge_on + c.hidden + c.black + c.partly_hidden + c.boundary + c.area_rule,
        scene.polygons.size())
        << sceneLine(scene);
  });
}

}  // namespace
}  // namespace irradiff
