// The checks of occluded scenes accept the library and reject twins made wrong for them.

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/visibility/boundary_of_view.h"
#include "verification/checks/input_families.h"
#include "verification/occlusion/scene_checks.h"
#include "verification/occlusion/scene_invariants.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>

namespace irradiff {
namespace {

constexpr std::uint64_t kSeed = 20120806;

/// The library's arcs and vertices, of a view that `spoil` made wrong; no bounds claimed.
SceneResult resultOf(const OccludedScene& scene, const std::function<void(VisibleBoundary&, const SceneMesh&)>& spoil,
                     double vertex_weight) {
  const SceneEvaluator evaluator(scene.polygons);
  VisibleBoundary view = evaluator.view(scene.receiver);
  spoil(view, evaluator.mesh());
  std::vector<double> radiances;
  for (const Polygon& polygon : scene.polygons) radiances.push_back(polygon.radiance);
  const double scale = std::ldexp(1.0, -evaluator.mesh().exponent());
  const BoundaryOfView<double> of_view = boundaryOfView<double>(
      evaluator.mesh(), view, radiances, scaled(scene.receiver.position, scale), scene.receiver.normal);
  const IrradianceDerivatives<double> d = boundarySums(of_view.boundary, scene.receiver.normal).derivatives;
  Eigen::Matrix3d hessian = d.hessian.value;
  for (const ApparentVertexTerm<double>& term : of_view.vertex_terms) hessian += vertex_weight * term.hessian;
  return {d.irradiance.value, Eigen::Vector3d(scale * d.gradient.value), Eigen::Matrix3d(scale * scale * hessian), {}};
}

void leave(VisibleBoundary&, const SceneMesh&) {}

SceneCandidate twin(const std::string& name, double vertex_weight,
                    const std::function<void(VisibleBoundary&, const SceneMesh&)>& spoil = leave) {
  return {name, [=](const OccludedScene& scene) { return resultOf(scene, spoil, vertex_weight); }};
}

OcclusionOptions few(std::size_t scenes) { return {.seed = kSeed, .scenes = lengthened(scenes)}; }

std::vector<Verdict> onTiltedScreens(const SceneCandidate& candidate) {
  return checkVisibleRegions(candidate, sceneFamily("tilted screens"), few(2));
}

/// Whether the verdict on one quantity is as given, and what it names as the cause.
void expectVerdict(const std::vector<Verdict>& verdicts, Quantity quantity, bool passed,
                   const std::string& cause = "") {
  const auto found = std::ranges::find(verdicts, quantity, &Verdict::quantity);
  ASSERT_NE(found, verdicts.end());
  EXPECT_EQ(found->passed, passed) << describe(*found);
  EXPECT_THAT(found->likely_cause, testing::HasSubstr(cause)) << describe(*found);
}

TEST(OcclusionChecks, AcceptTheLibrary) {
  const std::vector<Verdict> verdicts = checkOcclusion(libraryEvaluator(), few(4));
  for (const Verdict& verdict : verdicts) {
    EXPECT_TRUE(verdict.passed) << describe(verdict);
    std::cout << describe(verdict) << '\n';
  }
  // Every check has run on every family that it is for.
  const auto count = [&](const std::string& check) { return std::ranges::count(verdicts, check, &Verdict::check); };
  const auto families = static_cast<std::ptrdiff_t>(sceneFamilies().size());
  EXPECT_EQ(count("visible regions"), 3 * families);
  EXPECT_EQ(count("claimed bound"), 3 * families);
  EXPECT_EQ(count("energy"), families);
  EXPECT_EQ(count("quarter turn"), 3 * families);
  EXPECT_EQ(count("unit of length"), 3 * families);
  EXPECT_EQ(count("split polygon"), 3 * families);
  EXPECT_EQ(count("unseen polygon"), 3 * families);
  EXPECT_EQ(count("constant radiance"), 3);
}

TEST(OcclusionChecks, AcceptArcsAndVerticesOfTheTwins) {
  for (const Verdict& verdict : onTiltedScreens(twin("unspoilt", 1.0))) {
    EXPECT_TRUE(verdict.passed) << describe(verdict);
  }
}

TEST(OcclusionChecks, RejectAnOccluderIgnored) {
  const SceneCandidate library = libraryEvaluator();
  const SceneCandidate ignorant{"last occluder ignored", [library](OccludedScene scene) {
                                  scene.polygons.pop_back();
                                  return library.evaluate(scene);
                                }};
  const std::vector<Verdict> verdicts = onTiltedScreens(ignorant);
  for (const Quantity quantity : kSceneQuantities) {
    expectVerdict(verdicts, quantity, false, "polygons of radiance 0 are ignored");
  }
}

TEST(OcclusionChecks, RejectOcclusionIgnored) {
  const SceneCandidate library = libraryEvaluator();
  const SceneCandidate sum{
      "sum of polygons", [library](const OccludedScene& scene) {
        SceneResult result{0.0, Eigen::Vector3d::Zero().eval(), Eigen::Matrix3d::Zero().eval(), {}};
        for (const Polygon& polygon : scene.polygons) {
          const SceneResult alone = library.evaluate({{polygon}, scene.receiver});
          result.irradiance += alone.irradiance;
          *result.gradient += *alone.gradient;
          *result.hessian += *alone.hessian;
        }
        return result;
      }};
  const std::vector<Verdict> verdicts = onTiltedScreens(sum);
  for (const Quantity quantity : kSceneQuantities) expectVerdict(verdicts, quantity, false, "occlusion is ignored");
}

TEST(OcclusionChecks, RejectAnArcsSidesSwapped) {
  const std::vector<Verdict> verdicts =
      onTiltedScreens(twin("first arc's sides swapped", 1.0, [](VisibleBoundary& view, const SceneMesh&) {
        std::swap(view.arcs.front().sides.left, view.arcs.front().sides.right);
      }));
  for (const Quantity quantity : kSceneQuantities) expectVerdict(verdicts, quantity, false);
}

TEST(OcclusionChecks, RejectAHiddenEdgeCounted) {
  const auto wholeEdge = [](VisibleBoundary& view, const SceneMesh&) {
    for (VisibleArc& arc : view.arcs) {
      if (arc.first.kind == EdgePlace::Kind::kEdge || arc.last.kind == EdgePlace::Kind::kEdge) {
        arc.first = {EdgePlace::Kind::kStart};
        arc.last = {EdgePlace::Kind::kEnd};
        return;
      }
    }
  };
  const std::vector<Verdict> verdicts = onTiltedScreens(twin("hidden part of an edge counted", 1.0, wholeEdge));
  for (const Quantity quantity : kSceneQuantities) expectVerdict(verdicts, quantity, false);
}

TEST(OcclusionChecks, RejectTheVertexTermDropped) {
  // Irradiance and gradient are right: the Hessian's check does not build on them.
  const std::vector<Verdict> verdicts = onTiltedScreens(libraryEvaluator(ApparentVertices::kFixed));
  expectVerdict(verdicts, Quantity::kIrradiance, true);
  expectVerdict(verdicts, Quantity::kGradient, true);
  expectVerdict(verdicts, Quantity::kHessian, false, "apparent vertices are held fixed");
}

TEST(OcclusionChecks, RejectTheVertexTermWithTheWrongSign) {
  const std::vector<Verdict> verdicts = onTiltedScreens(twin("vertex terms negative", -1.0));
  expectVerdict(verdicts, Quantity::kGradient, true);
  expectVerdict(verdicts, Quantity::kHessian, false);
}

/// A library candidate whose result is changed.
SceneCandidate spoilt(const std::string& name, const std::function<void(const OccludedScene&, SceneResult&)>& spoil) {
  const SceneCandidate library = libraryEvaluator();
  return {name, [=](const OccludedScene& scene) {
            SceneResult result = library.evaluate(scene);
            spoil(scene, result);
            return result;
          }};
}

/// Names of the invariants that fail.
std::vector<std::string> brokenLaws(const SceneCandidate& candidate, const char* family = "tilted screens") {
  std::vector<std::string> broken;
  for (const Verdict& verdict : checkSceneInvariants(candidate, sceneFamily(family), few(20))) {
    if (!verdict.passed && (broken.empty() || broken.back() != verdict.check)) broken.push_back(verdict.check);
  }
  return broken;
}

TEST(OcclusionChecks, RejectACandidateThatBreaksALaw) {
  using Laws = std::vector<std::string>;
  EXPECT_EQ(brokenLaws(libraryEvaluator()), Laws{});
  EXPECT_EQ(brokenLaws(spoilt("more than there is",
                              [](const OccludedScene& scene, SceneResult& result) {
                                for (const Polygon& polygon : scene.polygons)
                                  result.irradiance += 4.0 * polygon.radiance;
                              })),
            (Laws{"energy", "split polygon"}));
  EXPECT_EQ(brokenLaws(spoilt("skewed",
                              [](const OccludedScene&, SceneResult& result) { result.gradient->x() *= 1.0 + 1e-9; })),
            Laws{"quarter turn"});
  EXPECT_EQ(brokenLaws(spoilt("a threshold in metres",
                              [](const OccludedScene& scene, SceneResult& result) {
                                if (extentOf(scene) > 1e3) *result.hessian *= 1.0 + 0x1p-52;
                              })),
            Laws{"unit of length"});
  EXPECT_EQ(brokenLaws(spoilt("counts polygons",
                              [](const OccludedScene& scene, SceneResult& result) {
                                *result.gradient *= 1.0 + 0x1p-52 * static_cast<double>(scene.polygons.size());
                              })),
            Laws{"unseen polygon"});
}

TEST(OcclusionChecks, RejectTooSmallABoundAndAnUnevenRoom) {
  const std::vector<Verdict> boasting = onTiltedScreens(
      spoilt("claims too much", [](const OccludedScene&, SceneResult& result) { result.bounds->hessian *= 1e-4; }));
  const auto claimed = std::ranges::find_if(boasting, [](const Verdict& verdict) {
    return verdict.check == "claimed bound" && verdict.quantity == Quantity::kHessian;
  });
  ASSERT_NE(claimed, boasting.end());
  EXPECT_FALSE(claimed->passed) << describe(*claimed);
  for (const Verdict& verdict : checkConstantRooms(spoilt("drifting",
                                                          [](const OccludedScene&, SceneResult& result) {
                                                            result.irradiance *= 1.0 + 1e-12;
                                                            result.gradient->array() += 1e-11;
                                                            result.hessian->array() += 1e-10;
                                                          }),
                                                   few(4))) {
    EXPECT_FALSE(verdict.passed) << describe(verdict);
  }
}

TEST(OcclusionChecks, CountExceptionsAndNaN) {
  const SceneCandidate throwing{"throws", [](const OccludedScene&) -> SceneResult { throw std::runtime_error("no"); }};
  const SceneCandidate undefined{"NaN", [](const OccludedScene&) { return SceneResult{std::nan(""), {}, {}, {}}; }};
  for (const SceneCandidate& candidate : {throwing, undefined}) {
    for (const Verdict& verdict : onTiltedScreens(candidate)) EXPECT_FALSE(verdict.passed) << describe(verdict);
  }
}

TEST(SceneFamilies, DependOnSeedFamilyAndIndexAlone) {
  for (const SceneFamily& family : sceneFamilies()) {
    const std::string line = sceneLine(drawScene(family, 3, 7));
    EXPECT_EQ(line, sceneLine(drawScene(family, 3, 7)));
    EXPECT_NE(line, sceneLine(drawScene(family, 4, 7)));
    EXPECT_NE(line, sceneLine(drawScene(family, 3, 8)));
  }
  EXPECT_THROW(sceneFamily("no such"), std::invalid_argument);
}

}  // namespace
}  // namespace irradiff
