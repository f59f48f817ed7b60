// The bounds of errors in occluded scenes, against the formulas at 200 digits (frozen_view_test.cpp shows that those
// are right), at random and where climbs make the errors large.

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/visibility/boundary_of_view.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/checks/input_families.h"
#include "verification/occlusion/frozen_view.h"
#include "verification/occlusion/gap_filling.h"
#include "verification/occlusion/scene_families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numeric>
#include <optional>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;
constexpr std::array<const char*, 5> kNames = {"irradiance", "gradient", "Hessian", "tangential Hessian",
                                               "rotational gradient"};

template <class Exact, class Values>
double errorOf(const Exact& expected, const Values& actual) {
  Multiprecision largest = 0;
  for (Eigen::Index i = 0; i < actual.size(); ++i) {
    largest = std::max<Multiprecision>(largest, abs(Multiprecision(actual(i)) - expected(i)));
  }
  return largest.convert_to<double>();
}

/// Errors of the five quantities, in the order of kNames.
std::array<double, 5> errorsOf(const IrradianceDerivatives<Multiprecision>& expected,
                               const IrradianceDerivatives<double>& actual) {
  return {Multiprecision(abs(expected.irradiance.value - actual.irradiance.value)).convert_to<double>(),
          errorOf(expected.gradient.value, actual.gradient.value),
          errorOf(expected.hessian.value, actual.hessian.value),
          errorOf(expected.tangential_hessian.value, actual.tangential_hessian.value),
          errorOf(expected.rotational_gradient.value, actual.rotational_gradient.value)};
}

std::array<double, 5> boundsOf(const DerivativeBounds& bounds) {
  return {bounds.irradiance, bounds.gradient, bounds.hessian, bounds.tangential_hessian, bounds.rotational_gradient};
}

/// Errors in units of the bounds; nothing where a quantity has no value or the library refuses the scene.
std::optional<std::array<double, 5>> sharesOfBounds(const OccludedScene& scene) {
  const SceneEvaluation<3> sum = SceneEvaluator(scene.polygons).evaluate(scene.receiver);
  if (!sum.no_gradient.empty() || !sum.no_hessian.empty() || !sum.no_tangential_hessian.empty()) return std::nullopt;
  const IrradianceDerivatives<Multiprecision> expected = FrozenView(scene).formulas();
  std::array<double, 5> shares = errorsOf(expected, sum.derivatives);
  const std::array<double, 5> bounds = boundsOf(sum.bounds);
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = shares[i] == 0.0 ? 0.0 : shares[i] / bounds[i];
  return shares;
}

void printShares(const char* what, const std::array<double, 5>& shares) {
  std::cout << what << ':';
  for (std::size_t i = 0; i < shares.size(); ++i) std::cout << ' ' << kNames[i] << ' ' << shares[i];
  std::cout << '\n';
}

TEST(ViewBounds, HoldInEveryScene) {
  for (const SceneFamily& family : sceneFamilies()) {
    std::array<double, 5> worst{};
    std::size_t without_value = 0;
    const std::size_t count = lengthened(60);
    for (std::size_t k = 0; k < count; ++k) {
      const OccludedScene scene = drawScene(family, kSeed, k);
      const std::optional<std::array<double, 5>> shares = sharesOfBounds(scene);
      if (!shares) ++without_value;
      for (std::size_t i = 0; shares && i < shares->size(); ++i) {
        EXPECT_LE((*shares)[i], 1.0) << kNames[i] << ' ' << sceneLine(scene);
        worst[i] = std::max(worst[i], (*shares)[i]);
      }
    }
    EXPECT_LE(without_value, count / 20);
    printShares(("error/bound, " + std::string(family.name)).c_str(), worst);
  }
}

OccludedScene nudged(OccludedScene scene, KeyedRandom& random) {
  const double step = random.decade(-16.0, -1.0) * extentOf(scene);
  if (random.unit() < 0.3) {
    scene.receiver.position += step * random.direction();
    return scene;
  }
  std::vector<Eigen::Vector3d>& vertices = scene.polygons[random.below(scene.polygons.size())].vertices;
  // Three vertices stay in a plane.
  vertices.resize(3);
  vertices[random.below(3)] += step * random.direction();
  return scene;
}

TEST(ViewBounds, HoldWhereClimbsMakeErrorsLarge) {
  std::array<double, 5> worst{};
  for (std::size_t quantity = 0; quantity < kNames.size(); ++quantity) {
    for (std::size_t start = 0; start < lengthened(2); ++start) {
      KeyedRandom random(kSeed, "climb", 8 * start + quantity);
      OccludedScene scene = drawScene(sceneFamily(start % 2 == 0 ? "near events" : "tilted screens"), kSeed, start);
      double best = 0.0;
      for (int step = 0; step < 60; ++step) {
        const OccludedScene next = nudged(scene, random);
        std::optional<std::array<double, 5>> shares;
        try {
          for (std::size_t i = 0; i < next.polygons.size(); ++i) validate(next.polygons[i], i);
          shares = sharesOfBounds(next);
        } catch (const InvalidScene&) {
          continue;
        }
        if (!shares || (*shares)[quantity] < best) continue;
        best = (*shares)[quantity];
        scene = next;
        ASSERT_LE(best, 1.0) << kNames[quantity] << ' ' << sceneLine(scene);
      }
      worst[quantity] = std::max(worst[quantity], best);
    }
  }
  printShares("error/bound after climbs", worst);
}

/// The scene on a grid on which differences of coordinates are exact, and its radiances.
struct SnappedScene {
  OccludedScene scene;
  std::vector<double> radiances;

  explicit SnappedScene(const OccludedScene& drawn) : scene(drawn) {
    const auto snapped = [](const Eigen::Vector3d& v) {
      return Eigen::Vector3d((v * 0x1p46).array().round() * 0x1p-46);
    };
    for (Polygon& polygon : scene.polygons) {
      for (Eigen::Vector3d& v : polygon.vertices) v = snapped(v);
      radiances.push_back(polygon.radiance);
    }
    scene.receiver.position = snapped(scene.receiver.position);
  }
};

/// In doubled precision the errors of places drown in the roundings of everything that follows. In plain double they do
/// not, and are to be within the same bounds in units of 64 u: each place, and each vertex' term.
TEST(ViewBounds, PlacesAreWithinTheirErrorsInPlainDouble) {
  constexpr double kPlainPlaceError = kPlaceError / 0x1p-53;
  double worst_place = 0.0;
  double worst_term = 0.0;
  double worst_conditioning = 0.0;
  std::size_t judged = 0;
  for (const char* name : {"near events", "piercing", "tilted receivers", "rooms"}) {
    for (std::size_t k = 0; k < lengthened(40); ++k) {
      const SnappedScene snapped(drawScene(sceneFamily(name), kSeed, k));
      const OccludedScene& scene = snapped.scene;
      const SceneEvaluator evaluator(scene.polygons);
      const SceneMesh& mesh = evaluator.mesh();
      const VisibleBoundary view = evaluator.view(scene.receiver);
      if (view.meeting_in_view || view.edges_in_line) continue;
      const Vector3<double> x = scaled(scene.receiver.position, std::ldexp(1.0, -mesh.exponent()));
      const Vector3<double>& n = scene.receiver.normal;
      const detail::ViewGeometry<double, double> plain(mesh, 0, x, n);
      const detail::ViewGeometry<Multiprecision, Multiprecision> exact(mesh, 0, withoutRounding(x), withoutRounding(n));
      for (const VisibleArc& arc : view.arcs) {
        for (const EdgePlace& place : {arc.first, arc.last}) {
          const auto actual = plain.place(arc.edge, place);
          // Vertices have no error in doubled precision, but do here.
          if (actual.error == 0.0 || !(kPlainPlaceError * actual.error < 0x1p-10)) continue;
          const auto expected = exact.place(arc.edge, place);
          const MultiprecisionVector off = withoutRounding(actual.position) - expected.position;
          const Multiprecision moved = std::max<Multiprecision>(norm(off), abs(expected.height - actual.height));
          const double share =
              Multiprecision(moved / expected.distance).convert_to<double>() / (kPlainPlaceError * actual.error);
          EXPECT_LE(share, 1.0) << sceneLine(scene);
          worst_place = std::max(worst_place, share);
          worst_conditioning = std::max(worst_conditioning, actual.error);
          ++judged;
        }
      }
      for (const ApparentVertex& vertex : view.apparent_vertices) {
        const ApparentVertexTerm<double> actual = apparentVertexTerm<double, double>(plain, vertex, 1.0);
        // Errors of first order are what is counted.
        if (!(kPlainPlaceError * actual.slack < 0x1p-7 * actual.size)) continue;
        const auto expected = apparentVertexTerm<Multiprecision, Multiprecision>(exact, vertex, Multiprecision(1));
        const double error = errorOf(expected.hessian, actual.hessian);
        const double share = error / (kPlainPlaceError * actual.slack + kVertexError * 0x1p-53 * actual.size);
        EXPECT_LE(share, 1.0) << sceneLine(scene);
        worst_term = std::max(worst_term, share);
      }
    }
  }
  std::cout << judged << " places in plain double, error/bound " << worst_place << ", the worst conditioned "
            << worst_conditioning << "; vertices " << worst_term << '\n';
  EXPECT_GE(judged, lengthened(500));
  // Places have been seen that are far worse conditioned than vertices, and errors of the order of their bounds.
  EXPECT_GE(worst_conditioning, 1e3);
  EXPECT_GE(worst_place, 1e-3);
}

/// What errors of an arc's ends make of its terms, by moving the ends at 200 digits: within the slack that
/// boundaryOfView adds up.
TEST(ViewBounds, SlackCoversWhatEndsMakeOfAnArc) {
  const Multiprecision shift = ldexp(Multiprecision(1), -100);
  std::array<double, 5> worst{};
  for (std::size_t k = 0; k < lengthened(400); ++k) {
    KeyedRandom random(kSeed, "moved ends", k);
    const auto vectorOf = [](const Eigen::Vector3d& v) { return withoutRounding(v); };
    // From short arcs to such that all but pass through the receiver.
    const Eigen::Vector3d first = random.decade(-2.0, 2.0) * random.direction();
    const double spread = random.decade(-6.0, 1.0);
    const Eigen::Vector3d last =
        k % 2 == 0 ? Eigen::Vector3d(first + spread * first.norm() * random.direction())
                   : Eigen::Vector3d(random.decade(-2.0, 2.0) * (spread * random.direction() - first).normalized());
    // A normal with both ends above the horizon: from the plane's normal and the two of the ends in the plane.
    const Eigen::Vector3d w0 = first.normalized();
    const Eigen::Vector3d w1 = last.normalized();
    const Eigen::Vector3d m = w0.cross(w1).normalized();
    const MultiprecisionVector normal = vectorOf(
        (random.between(-1.0, 1.0) * m + random.unit() * m.cross(w0) + random.unit() * w1.cross(m)).normalized());
    const auto boundaryFor = [&](const MultiprecisionVector& r0, const MultiprecisionVector& r1,
                                 const Multiprecision& h0, const Multiprecision& h1) {
      RadianceBoundary<Multiprecision> boundary;
      appendEdgeArcs<Multiprecision, Multiprecision>({r0, h0}, {r1, h1}, normal, Multiprecision(1), boundary.arcs);
      return boundary;
    };
    const MultiprecisionVector r0 = vectorOf(first);
    const MultiprecisionVector r1 = vectorOf(last);
    const RadianceBoundary<Multiprecision> right = boundaryFor(r0, r1, dot(normal, r0), dot(normal, r1));
    const auto movedBy = [&](const MultiprecisionVector& r) {
      return MultiprecisionVector(r + vectorOf(random.direction()) * Multiprecision(shift * norm(r)));
    };
    const MultiprecisionVector q0 = movedBy(r0);
    const MultiprecisionVector q1 = movedBy(r1);
    const Multiprecision sign0 = random.unit() < 0.5 ? -1 : 1;
    const Multiprecision sign1 = random.unit() < 0.5 ? -1 : 1;
    const RadianceBoundary<Multiprecision> moved =
        boundaryFor(q0, q1, dot(normal, r0) + sign0 * shift * norm(r0), dot(normal, r1) + sign1 * shift * norm(r1));
    if (moved.arcs.size() != right.arcs.size()) continue;
    const auto sensitivity =
        detail::arcSensitivity<Multiprecision>(right.arcs, norm(r0), norm(r1), norm(MultiprecisionVector(r1 - r0)));
    const auto of_right = boundarySums(right, normal).derivatives;
    const auto of_moved = boundarySums(moved, normal).derivatives;
    // Both ends are off by `shift`.
    const Multiprecision slack = 2 * shift * sensitivity.angle_over_sine;
    const Multiprecision gradient_slack = kGradientSlack * slack * sensitivity.kappa;
    const Multiprecision hessian_slack = kHessianSlack * slack * sensitivity.kappa * sensitivity.kappa;
    const auto share = [](const auto& a, const auto& b, const Multiprecision& allowed) {
      Multiprecision largest = 0;
      for (Eigen::Index i = 0; i < a.size(); ++i) largest = std::max<Multiprecision>(largest, abs(a(i) - b(i)));
      return Multiprecision(largest / allowed).convert_to<double>();
    };
    const std::array<double, 5> shares = {
        Multiprecision(abs(of_moved.irradiance.value - of_right.irradiance.value) / slack).convert_to<double>(),
        share(of_moved.gradient.value, of_right.gradient.value, gradient_slack),
        share(of_moved.hessian.value, of_right.hessian.value, hessian_slack),
        share(of_moved.tangential_hessian.value, of_right.tangential_hessian.value, hessian_slack),
        share(of_moved.rotational_gradient.value, of_right.rotational_gradient.value, slack)};
    for (std::size_t i = 0; i < shares.size(); ++i) {
      EXPECT_LE(shares[i], 1.0) << kNames[i] << ' ' << first.transpose() << ", " << last.transpose();
      worst[i] = std::max(worst[i], shares[i]);
    }
  }
  printShares("moved ends, change/slack", worst);
  for (const double share : worst) EXPECT_GE(share, 1e-3);
}

/// A lamp's edge and a screen's that cross in view, about in their middles, at this angle.
OccludedScene crossingAt(double angle) {
  return {
      {{"lamp", {{-1.0, 0.0, 2.0}, {1.0, 0.0, 2.0}, {1.0, 1.0, 2.0}, {-1.0, 1.0, 2.0}}, 3.0},
       {"screen", {{-0.4, -0.5 * angle, 1.0}, {0.4, 0.5 * angle, 1.0}, {0.4, -0.5, 1.25}, {-0.4, -0.5, 1.25}}, 0.0}},
      {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}}};
}

TEST(ViewBounds, EdgesThatAllButLieOverEachOther) {
  for (const double angle : {0x1p-10, 0x1p-30, 0x1p-50, 0x1p-70, 0x1p-80}) {
    const OccludedScene scene = crossingAt(angle);
    const std::optional<std::array<double, 5>> shares = sharesOfBounds(scene);
    ASSERT_TRUE(shares) << angle;
    for (std::size_t i = 0; i < shares->size(); ++i) EXPECT_LE((*shares)[i], 1.0) << kNames[i] << ' ' << angle;
    const SceneEvaluation<3> sum = SceneEvaluator(scene.polygons).evaluate(scene.receiver);
    EXPECT_GE(sum.apparent_vertices, 1U);
    // The smaller the angle, the faster the crossing runs along the edges; the bound stays a small part of that.
    const double size = sum.derivatives.hessian.value.cwiseAbs().maxCoeff();
    EXPECT_GE(size, 1e-3 / angle);
    EXPECT_LE(sum.bounds.hessian, 0.01 * size) << angle;
  }
  // Where they cross is beyond doubled precision.
  const OccludedScene scene = crossingAt(0x1p-110);
  EXPECT_THAT([&] { SceneEvaluator(scene.polygons).evaluate(scene.receiver); },
              testing::ThrowsMessage<InvalidScene>(testing::HasSubstr("the receiver at [0, 0, 0]")));
}

TEST(ViewBounds, ThirteenDigitsAwayFromEvents) {
  double worst_gradient = 0.0;
  double worst_hessian = 0.0;
  std::size_t judged = 0;
  for (const SceneFamily& family : sceneFamilies()) {
    for (std::size_t k = 0; k < lengthened(40); ++k) {
      const OccludedScene scene = drawScene(family, kSeed + 2, k);
      if (!isClearOfEvents(scene, 1e-4)) continue;
      const SceneEvaluation<3> sum = SceneEvaluator(scene.polygons).evaluate(scene.receiver);
      if (sum.derivatives.irradiance.value == 0.0) continue;
      const IrradianceDerivatives<Multiprecision> expected = FrozenView(scene).formulas();
      const std::array<double, 5> errors = errorsOf(expected, sum.derivatives);
      const double gradient = errors[1] / sum.derivatives.gradient.value.cwiseAbs().maxCoeff();
      const double hessian = errors[2] / sum.derivatives.hessian.value.cwiseAbs().maxCoeff();
      EXPECT_LE(gradient, 1e-13) << sceneLine(scene);
      EXPECT_LE(hessian, 1e-13) << sceneLine(scene);
      worst_gradient = std::max(worst_gradient, gradient);
      worst_hessian = std::max(worst_hessian, hessian);
      ++judged;
    }
  }
  EXPECT_GE(judged, lengthened(200));
  std::cout << judged << " scenes, relative errors: gradient " << worst_gradient << ", Hessian " << worst_hessian
            << '\n';
}

TEST(GapFilling, LosesTheMotionOfApparentVertices) {
  const GapFillingErrors losses = gapFillingErrors(sceneFamily("tilted screens"), 200, kSeed);
  ASSERT_GE(losses.errors.size(), 100U);
  const ErrorHistogram histogram = histogramOf(losses.errors);
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t{0}), losses.errors.size());
  std::cout << "gap filling, " << losses.without_vertices
            << " scenes without apparent vertices; others by decade of the Hessian's relative error:";
  for (const std::size_t count : histogram.counts) std::cout << ' ' << count;
  std::cout << '\n';
  // Half of the scenes lose more than a tenth of their Hessian.
  EXPECT_GT(histogram.counts[8] + histogram.counts[9] + histogram.counts[10], losses.errors.size() / 3);
}

// What is lost is what differences of irradiance, in which no apparent vertex is known, find missing.
TEST(GapFilling, LosesWhatDifferencesMiss) {
  const SceneFamily& family = sceneFamily("tilted screens");
  const GapFillingErrors losses = gapFillingErrors(family, 12, kSeed);
  std::vector<double> lost(losses.without_vertices, 0.0);
  lost.insert(lost.end(), losses.errors.begin(), losses.errors.end());
  std::vector<double> missing;
  for (const GapFillingResiduals& residuals : gapFillingResiduals(family, 12, kSeed))
    missing.push_back(residuals.fixed);
  ASSERT_EQ(lost.size(), missing.size());
  std::ranges::sort(lost);
  std::ranges::sort(missing);
  EXPECT_GT(missing.back(), 0.1);
  // The promise away from events, for each of the two Hessians.
  for (std::size_t i = 0; i < lost.size(); ++i) EXPECT_NEAR(lost[i], missing[i], 2e-13 * (1.0 + missing[i]));
}

TEST(GapFilling, BinsBeginAtTheirPowerOfTen) {
  const ErrorHistogram histogram = histogramOf({0.0, 9e-9, 1.1e-8, 0.5, 5.0, 10.5, 1e9});
  EXPECT_THAT(histogram.counts, testing::ElementsAre(2, 1, 0, 0, 0, 0, 0, 0, 1, 1, 2));
  EXPECT_EQ(ErrorHistogram::decadeOf(1), -8);
  EXPECT_EQ(ErrorHistogram::decadeOf(10), 1);
}

}  // namespace
}  // namespace irradiff
