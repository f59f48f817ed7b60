// Derivatives from the mesh over hemisphere samples, against the published sum over triangles at 100 digits and against
// polygon form factors; constant radiance; degenerate samples.

#include "derivatives/estimators/triangulated.h"

#include "derivatives/estimators/mesh_derivatives.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/samples/sample_mesh.h"
#include "tests/estimators/sampled_scene.h"
#include "tests/estimators/triangle_sum.h"
#include "verification/comparison/error_statistics.h"

#include <boost/multiprecision/mpfr.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

using Digits100 =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<100>, boost::multiprecision::et_off>;

/// What the estimators are to keep, norm-wise, of the same sum at 100 digits.
constexpr double kRounding = 1e-13;

constexpr MeshRim kRims[] = {MeshRim::kOpen, MeshRim::kDownToHorizon};

std::unique_ptr<Estimator> makeEstimatorWith(MeshRim rim, const HemisphereSamples& samples) {
  return rim == MeshRim::kOpen ? makeTriangulated(samples.stratification, samples.shape)
                               : makeTriangulatedClosed(samples.stratification, samples.shape);
}

MeshDerivatives estimated(MeshRim rim, const HemisphereSamples& samples) {
  const IrradianceEstimate estimate = makeEstimatorWith(rim, samples)->estimate(samples);
  EXPECT_EQ(*estimate.tangential_hessian, (estimate.hessian->topLeftCorner<2, 2>()));
  EXPECT_TRUE(estimate.knows_normal_component);
  return {*estimate.gradient, *estimate.hessian};
}

/// The published sum at 100 digits, rounded.
MeshDerivatives published(MeshRim rim, const HemisphereSamples& samples, CornerRule rule = CornerRule::kFarthest) {
  const SampleMesh mesh(samples.stratification, samples.shape, rim);
  return rounded(triangleSum(meshVertices<Digits100>(mesh, samples), radiantTriangles(mesh, samples, rule)));
}

/// Norm-wise, the larger of gradient's, Hessian's and tangential Hessian's.
double relativeError(const MeshDerivatives& value, const MeshDerivatives& reference) {
  const auto error = [](const auto& a, const auto& b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
  };
  return std::max({error(value.gradient, reference.gradient), error(value.hessian, reference.hessian),
                   error(value.hessian.topLeftCorner<2, 2>().eval(), reference.hessian.topLeftCorner<2, 2>().eval())});
}

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

/// The room with walls of different radiance and a black square in it.
std::vector<Polygon> colouredRoom() {
  std::vector<Polygon> scene = room(1.0);
  const std::vector<double> radiances{0.9, 0.3, 0.6, 0.1, 1.5};
  for (std::size_t i = 0; i < scene.size(); ++i) scene[i].radiance = radiances[i];
  scene.push_back(parallelogram("square", {0.0, 0.0, 0.5}, {0.35, 0.0, 0.0}, {0.0, 0.35, 0.0}, 0.0));
  return scene;
}

HemisphereSamples roomSamples(const Strata& strata, std::uint64_t seed) {
  return sampleScene(colouredRoom(), frameAt({0.31, -0.17, 0.0}), strata, SamplePlaces::jittered(seed));
}

/// Radiance different at every sample.
HemisphereSamples withRandomRadiance(HemisphereSamples samples) {
  std::mt19937_64 random(5);
  for (double& radiance : samples.radiance) radiance = uniform(random);
  return samples;
}

std::vector<Strata> assortedStrata() {
  using enum Stratification;
  return {{kConcentric, {2, 2}},   {kConcentric, {3, 3}}, {kConcentric, {2, 9}}, {kConcentric, {7, 12}},
          {kConcentric, {16, 16}}, {kPolar, {1, 4}},      {kPolar, {4, 7}},      {kPolar, {8, 24}},
          {kHemicube, {6, 2}},     {kHemicube, {12, 4}},  {kHemicube, {30, 10}}};
}

TEST(Triangulated, IsThePublishedSumTo100Digits) {
  for (const MeshRim rim : kRims) {
    ErrorStatistics errors;
    std::size_t input = 0;
    for (const Strata& strata : assortedStrata()) {
      for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const HemisphereSamples walls = roomSamples(strata, seed);
        for (const HemisphereSamples& samples : {walls, withRandomRadiance(walls)}) {
          const double error = relativeError(estimated(rim, samples), published(rim, samples));
          EXPECT_LE(error, kRounding) << samples.shape.rows << " x " << samples.shape.columns << ", seed " << seed;
          errors.add(error, input++);
        }
      }
    }
    std::cout << "small grids, relative error against 100 digits: peak " << errors.peak() << ", RMS "
              << errors.rootMeanSquare() << " in " << errors.count() << " (worst " << errors.worstInput() << ")\n";
  }
}

TEST(Triangulated, RecordOf64By64IsThePublishedSumTo100Digits) {
  for (const Strata& strata :
       {Strata(Stratification::kConcentric, {64, 64}), Strata(Stratification::kHemicube, {96, 32})}) {
    const HemisphereSamples walls = roomSamples(strata, 1);
    for (const MeshRim rim : kRims) {
      const double of_walls = relativeError(estimated(rim, walls), published(rim, walls));
      const HemisphereSamples different = withRandomRadiance(walls);
      const double of_different = relativeError(estimated(rim, different), published(rim, different));
      EXPECT_LE(of_walls, kRounding);
      EXPECT_LE(of_different, kRounding);
      std::cout << walls.shape.rows << " x " << walls.shape.columns << ", relative error against 100 digits: walls "
                << of_walls << ", every sample different " << of_different << '\n';
    }
  }
}

TEST(Triangulated, WithAFaultIsNotThePublishedSum) {
  const HemisphereSamples samples = roomSamples({Stratification::kConcentric, {16, 16}}, 1);
  for (const MeshRim rim : kRims) {
    const MeshDerivatives value = estimated(rim, samples);
    const MeshRim other = rim == MeshRim::kOpen ? MeshRim::kDownToHorizon : MeshRim::kOpen;
    EXPECT_GT(relativeError(value, published(other, samples)), 0.01) << "rim left open or closed";
    EXPECT_GT(relativeError(value, published(rim, samples, CornerRule::kNearest)), 0.01) << "nearest corner";
    const SampleMesh mesh(samples.stratification, samples.shape, rim);
    std::vector<RadiantTriangle> triangles = radiantTriangles(mesh, samples);
    const std::vector<MeshVertex<double>> vertices = meshVertices<double>(mesh, samples);
    // The other diagonal of one quadrilateral in 225, a triangle missing, one turned over.
    const std::size_t upper = 7 * 30 + 15 + 7;
    const std::size_t lower = upper - 15;
    ASSERT_EQ(triangles[lower].corners[2], triangles[upper].corners[1]);
    std::vector<RadiantTriangle> faulty = triangles;
    faulty[lower].corners[2] = faulty[upper].corners[2];
    faulty[upper].corners[0] = faulty[lower].corners[1];
    faulty[lower].radiance += 1.0;
    triangles[lower].radiance += 1.0;
    const double jump_of_diagonal =
        relativeError(rounded(triangleSum(vertices, faulty)), rounded(triangleSum(vertices, triangles)));
    EXPECT_GT(jump_of_diagonal, 1e3 * kRounding) << "the other diagonal";
    std::vector<RadiantTriangle> missing = radiantTriangles(mesh, samples);
    missing.erase(std::max_element(missing.begin(), missing.end(),
                                   [](const auto& a, const auto& b) { return a.radiance < b.radiance; }));
    EXPECT_GT(relativeError(value, rounded(triangleSum(vertices, missing))), 1e3 * kRounding) << "a triangle missing";
  }
}

TEST(Triangulated, IsTheSumOfPolygonFormFactors) {
  const Receiver receiver{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};
  for (const Strata& strata : assortedStrata()) {
    HemisphereSamples samples = roomSamples(strata, 7);
    std::mt19937_64 random(11);
    for (double& inverse_distance : samples.inverse_distance) inverse_distance = 0.2 + uniform(random);
    samples = withRandomRadiance(samples);
    const SampleMesh mesh(samples.stratification, samples.shape, MeshRim::kOpen);
    MeshDerivatives sum{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
    double gradient_bound = 0.0;
    double hessian_bound = 0.0;
    for (const RadiantTriangle& triangle : radiantTriangles(mesh, samples)) {
      Polygon polygon{"triangle", {}, 1.0};
      for (const std::size_t corner : triangle.corners) {
        polygon.vertices.emplace_back(samples.direction(corner) / samples.inverse_distance[corner]);
      }
      const PolygonEvaluation evaluation = evaluatePolygon(polygon, 0, receiver);
      const double sign = evaluation.is_clockwise ? triangle.radiance : -triangle.radiance;
      sum.gradient += sign * evaluation.derivatives.gradient.value;
      sum.hessian += sign * evaluation.derivatives.hessian.value;
      gradient_bound += triangle.radiance * evaluation.bounds.gradient;
      hessian_bound += triangle.radiance * evaluation.bounds.hessian;
    }
    const MeshDerivatives value = estimated(MeshRim::kOpen, samples);
    // Corners are rounded once more here: 4 u of their position, which is what the bounds of polygons count in.
    const double gradient_error = (value.gradient - sum.gradient).cwiseAbs().maxCoeff();
    const double hessian_error = (value.hessian - sum.hessian).cwiseAbs().maxCoeff();
    EXPECT_LE(gradient_error, gradient_bound) << samples.shape.rows << " x " << samples.shape.columns;
    EXPECT_LE(hessian_error, hessian_bound) << samples.shape.rows << " x " << samples.shape.columns;
    // A polygon the wrong way round would not pass.
    EXPECT_GT(sum.hessian.cwiseAbs().maxCoeff(), 1e6 * hessian_bound);
  }
}

TEST(Triangulated, OfConstantRadianceIsZeroWhereTheMeshIsClosed) {
  std::vector<Strata> all = assortedStrata();
  all.emplace_back(Stratification::kConcentric, GridShape{64, 64});
  for (const Strata& strata : all) {
    for (const std::uint64_t seed : {1U, 2U}) {
      HemisphereSamples samples = roomSamples(strata, seed);
      samples.radiance.assign(samples.radiance.size(), 0.7);
      samples.inverse_distance[1] = 0.0;
      const MeshDerivatives closed = estimated(MeshRim::kDownToHorizon, samples);
      EXPECT_EQ(closed.gradient, Eigen::Vector3d::Zero());
      EXPECT_EQ(closed.hessian, Eigen::Matrix3d::Zero());
      EXPECT_GT(estimated(MeshRim::kOpen, samples).hessian.cwiseAbs().maxCoeff(), 0.01) << "the open mesh";
    }
  }
}

TEST(MeshDerivatives, AreTheSameBitsWithAllInstructions) {
  for (const Strata& strata : assortedStrata()) {
    const HemisphereSamples walls = roomSamples(strata, 3);
    for (const HemisphereSamples& samples : {walls, withRandomRadiance(walls)}) {
      for (const MeshRim rim : kRims) {
        const SampleMesh mesh(samples.stratification, samples.shape, rim);
        const MeshSamples input{samples.direction_t, samples.direction_b, samples.direction_n, samples.inverse_distance,
                                samples.radiance};
        const MeshDerivatives plain = meshDerivatives(mesh, input, VectorInstructions::kNone);
        for (const VectorInstructions instructions : vectorInstructions()) {
          const MeshDerivatives value = meshDerivatives(mesh, input, instructions);
          EXPECT_EQ(value.gradient, plain.gradient) << static_cast<int>(instructions);
          EXPECT_EQ(value.hessian, plain.hessian) << static_cast<int>(instructions);
        }
      }
    }
  }
}

TEST(Triangulated, KeepsItsBitsWhenUnitsChangeByPowersOfTwo) {
  const HemisphereSamples samples = roomSamples({Stratification::kConcentric, {8, 8}}, 3);
  const MeshDerivatives value = estimated(MeshRim::kDownToHorizon, samples);
  for (const int exponent : {-500, -40, 3, 400}) {
    HemisphereSamples scaled = samples;
    for (double& inverse_distance : scaled.inverse_distance) inverse_distance = std::ldexp(inverse_distance, exponent);
    for (double& radiance : scaled.radiance) radiance = std::ldexp(radiance, -exponent);
    const MeshDerivatives scaled_value = estimated(MeshRim::kDownToHorizon, scaled);
    EXPECT_EQ(scaled_value.gradient, value.gradient) << exponent;
    EXPECT_EQ(scaled_value.hessian, std::ldexp(1.0, exponent) * value.hessian) << exponent;
  }
}

TEST(Triangulated, IsFiniteForDegenerateSamples) {
  for (const Strata& strata : assortedStrata()) {
    const HemisphereSamples good = roomSamples(strata, 3);
    const auto expectFinite = [&](const std::string& what, const auto& change) {
      HemisphereSamples samples = withRandomRadiance(good);
      for (std::size_t i = 0; i < samples.radiance.size(); ++i) change(samples, i);
      for (const MeshRim rim : kRims) {
        const MeshDerivatives value = estimated(rim, samples);
        EXPECT_TRUE(value.gradient.allFinite() && value.hessian.allFinite())
            << what << ", " << samples.shape.rows << " x " << samples.shape.columns;
      }
    };
    const auto point = [](HemisphereSamples& samples, std::size_t i, const Eigen::Vector3d& w) {
      samples.direction_t[i] = w(0);
      samples.direction_b[i] = w(1);
      samples.direction_n[i] = w(2);
    };
    expectFinite("no hits", [](HemisphereSamples& s, std::size_t i) { s.inverse_distance[i] = 0.0; });
    expectFinite("misses between hits", [](HemisphereSamples& s, std::size_t i) {
      if (i % 3 == 0) s.inverse_distance[i] = 0.0;
    });
    expectFinite("all straight above", [&](HemisphereSamples& s, std::size_t i) { point(s, i, {0, 0, 1}); });
    expectFinite("every other straight above", [&](HemisphereSamples& s, std::size_t i) {
      if (i % 2 == 0) point(s, i, {0, 0, 1});
    });
    expectFinite("all on the horizon", [&](HemisphereSamples& s, std::size_t i) {
      const auto angle = static_cast<double>(i);
      point(s, i, {std::cos(angle), std::sin(angle), 0.0});
    });
    expectFinite("opposite on the horizon", [&](HemisphereSamples& s, std::size_t i) {
      point(s, i, {i % 2 == 0 ? 1.0 : -1.0, 0.0, 0.0});
    });
    expectFinite("almost opposite", [&](HemisphereSamples& s, std::size_t i) {
      point(s, i, {i % 2 == 0 ? 1.0 : -1.0, 0.0, i % 2 == 0 ? 1e-30 : 0.0});
    });
    expectFinite("as near and as far as numbers go", [](HemisphereSamples& s, std::size_t i) {
      s.inverse_distance[i] = i % 2 == 0 ? 1e150 : std::numeric_limits<double>::denorm_min();
    });
    expectFinite("as far as numbers go", [](HemisphereSamples& s, std::size_t i) {
      s.inverse_distance[i] = std::numeric_limits<double>::denorm_min();
    });
    expectFinite("as bright as numbers go",
                 [](HemisphereSamples& s, std::size_t i) { s.radiance[i] = i % 2 == 0 ? 1e305 : 0.0; });
  }
}

/// A hit that two rays share, or two hits on one ray, add what a mesh without one of them adds.
TEST(Triangulated, OfCoincidentSamplesIsThePublishedSum) {
  HemisphereSamples samples = withRandomRadiance(roomSamples({Stratification::kConcentric, {8, 8}}, 3));
  for (const std::size_t i : {9U, 27U, 33U}) {
    samples.direction_t[i + 1] = samples.direction_t[i];
    samples.direction_b[i + 1] = samples.direction_b[i];
    samples.direction_n[i + 1] = samples.direction_n[i];
  }
  samples.inverse_distance[10] = samples.inverse_distance[9];
  samples.inverse_distance[40] = 0.0;
  for (const MeshRim rim : kRims) {
    EXPECT_LE(relativeError(estimated(rim, samples), published(rim, samples)), kRounding);
  }
}

TEST(Triangulated, WithoutAMeshKnowsIrradianceOnly) {
  using enum Stratification;
  for (const Strata& strata : {Strata(kConcentric, {1, 1}), Strata(kConcentric, {1, 5}), Strata(kPolar, {4, 3})}) {
    const HemisphereSamples samples = uniformSamples(strata, 2.0, 1.0);
    for (const MeshRim rim : kRims) {
      const IrradianceEstimate estimate = makeEstimatorWith(rim, samples)->estimate(samples);
      EXPECT_NEAR(estimate.irradiance, std::numbers::pi, 16.0 * 0x1p-53 * std::numbers::pi);
      EXPECT_FALSE(estimate.gradient || estimate.hessian || estimate.tangential_hessian);
      EXPECT_FALSE(estimate.knows_normal_component);
    }
  }
}

}  // namespace
}  // namespace irradiff
