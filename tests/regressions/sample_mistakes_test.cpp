// Mistakes with hemisphere samples.

#include "derivatives/error_metric/harmonic_mean_distance.h"
#include "derivatives/estimators/estimator.h"
#include "derivatives/samples/sample_hemisphere.h"

#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <numbers>

namespace irradiff {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
const SampleFrame kFrame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// The gradient in the tangent plane by Ward and Heckbert (1992, their equation for the translation gradient), written
/// out for polar strata with its loops; `first_ring` is where those over the walls between azimuths begin.
Vector2d wardHeckbertSum(const HemisphereSamples& samples, std::size_t first_ring) {
  const std::size_t rings = samples.shape.rows;
  const std::size_t azimuths = samples.shape.columns;
  const auto at = [&](std::size_t j, std::size_t k) { return j * azimuths + k; };
  const auto nearer = [&](std::size_t a, std::size_t b) {
    return std::max(samples.inverse_distance[a], samples.inverse_distance[b]);
  };
  const auto sine = [&](std::size_t j) { return std::sqrt(static_cast<double>(j) / static_cast<double>(rings)); };
  Vector2d gradient = Vector2d::Zero();
  for (std::size_t k = 0; k < azimuths; ++k) {
    const std::size_t before = (k + azimuths - 1) % azimuths;
    const double middle = 2.0 * kPi * (static_cast<double>(k) + 0.5) / static_cast<double>(azimuths);
    const double start = 2.0 * kPi * static_cast<double>(k) / static_cast<double>(azimuths);
    double along = 0.0;
    for (std::size_t j = 1; j < rings; ++j) {
      along += sine(j) * (1.0 - sine(j) * sine(j)) * nearer(at(j, k), at(j - 1, k)) *
               (samples.radiance[at(j, k)] - samples.radiance[at(j - 1, k)]);
    }
    double across = 0.0;
    for (std::size_t j = first_ring; j < rings; ++j) {
      across += (sine(j + 1) - sine(j)) * nearer(at(j, k), at(j, before)) *
                (samples.radiance[at(j, k)] - samples.radiance[at(j, before)]);
    }
    gradient += 2.0 * kPi / static_cast<double>(azimuths) * along * Vector2d(std::cos(middle), std::sin(middle)) +
                across * Vector2d(-std::sin(start), std::cos(start));
  }
  return gradient;
}

constexpr std::size_t kRings = 8;
constexpr std::size_t kAzimuths = 64;
constexpr double kDome = 2.0;

/// Half of the innermost ring's patch of a dome is bright: x > 0.
double domeRadiance(const Vector3d& direction) {
  return direction(0) > 0.0 && direction.head<2>().squaredNorm() < 1.0 / static_cast<double>(kRings) ? 5.0 : 0.0;
}

HemisphereSamples domeSamples() {
  return sampleHemisphere(Strata(Stratification::kPolar, {kRings, kAzimuths}), SamplePattern::kCentred, 1, 0, kFrame,
                          [](const Vector3d& w) {
                            return RayHit{1.0 / kDome, domeRadiance(w)};
                          });
}

/// dE/dx of that dome: the integral of L times the derivative of cos cos'/r^2 over the bright patch, which knows
/// nothing of strata or walls.
double domeGradient() {
  const auto kernel = [](const Vector3d& point, double x) {
    const Vector3d r = point - Vector3d(x, 0.0, 0.0);
    return r(2) * r.dot(point / kDome) / std::pow(r.squaredNorm(), 2);
  };
  using Rule = boost::math::quadrature::gauss<double, 30>;
  const double widest = std::asin(std::sqrt(1.0 / static_cast<double>(kRings)));
  return Rule::integrate(
      [&](double theta) {
        return Rule::integrate(
            [&](double phi) {
              const Vector3d point =
                  kDome * Vector3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
              constexpr double kStep = 1e-4;
              const double slope = (kernel(point, kStep) - kernel(point, -kStep)) / (2.0 * kStep);
              return 5.0 * slope * kDome * kDome * std::sin(theta);
            },
            -0.5 * kPi, 0.5 * kPi);
      },
      0.0, widest);
}

TEST(Regressions, StrataLoopThatSkipsTheInnermostRing) {
  const HemisphereSamples samples = domeSamples();
  const double truth = domeGradient();
  const double library =
      makeEstimator("ward-heckbert", samples.stratification, samples.shape)->estimate(samples).gradient->x();
  // The walls between rings are as long as the arcs they stand for and straight: with x = pi/64 the sum over them,
  // which is all that a loop over no ring leaves, is too large by x/sin x. Then what the differences of the truth
  // leave.
  const double x = kPi / static_cast<double>(kAzimuths);
  const double allowed = (x / std::sin(x) - 1.0) * std::abs(wardHeckbertSum(samples, kRings).x()) + 1e-7;
  EXPECT_NEAR(library, truth, allowed);
  EXPECT_NEAR(wardHeckbertSum(samples, 0).x(), truth, allowed);
  const double mistaken = wardHeckbertSum(samples, 1).x();
  std::cout << "innermost ring: truth " << truth << ", library " << library << ", loop from 1: " << mistaken << '\n';
  EXPECT_GT(std::abs(mistaken - truth), 0.5 * std::abs(truth));
}

/// The mistake: the boundary of each cell's directions is summed up with r x r' normalised by its length, whatever
/// that is. Vector irradiance of the quadrilaterals between neighbouring samples, one radiance each.
Vector3d vectorIrradianceOfCells(const HemisphereSamples& samples) {
  Vector3d sum = Vector3d::Zero();
  const std::size_t columns = samples.shape.columns;
  for (std::size_t row = 0; row + 1 < samples.shape.rows; ++row) {
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const std::size_t corner = row * columns + column;
      const std::size_t loop[] = {corner, corner + 1, corner + columns + 1, corner + columns};
      for (std::size_t i = 0; i < 4; ++i) {
        const Vector3d a = samples.direction(loop[i]);
        const Vector3d b = samples.direction(loop[(i + 1) % 4]);
        const Vector3d moment = a.cross(b);
        sum += 0.5 * samples.radiance[corner] * std::acos(a.dot(b)) * moment / moment.norm();
      }
    }
  }
  return sum;
}

/// Concentric strata under a sloping ceiling; two neighbours moved to the border between them, and `apart` from it.
HemisphereSamples withPairAtBorder(double apart) {
  const Strata strata(Stratification::kConcentric, {8, 8});
  const auto look = [](const Vector3d& w) { return RayHit{(w(2) + 0.3 * w(0) + 0.5) / 3.0, 1.0 + w(1)}; };
  HemisphereSamples samples = sampleHemisphere(strata, SamplePattern::kJittered, 3, 0, kFrame, look);
  for (const auto& [column, along] : {std::pair<std::size_t, double>{2, 1.0 - apart}, {3, apart}}) {
    const Vector3d w = strata.direction({4, column, along, 0.4});
    const std::size_t sample = 4 * 8 + column;
    samples.direction_t[sample] = w(0);
    samples.direction_b[sample] = w(1);
    samples.direction_n[sample] = w(2);
    // Where directions coincide, so do the hits.
    samples.inverse_distance[sample] = look(w).inverse_distance;
    samples.radiance[sample] = look(w).radiance;
  }
  return samples;
}

TEST(Regressions, CoincidentSamplesThatTurnARecordIntoNaN) {
  const HemisphereSamples coincident = withPairAtBorder(0.0);
  const HemisphereSamples apart = withPairAtBorder(1e-7);
  ASSERT_EQ(coincident.direction(34), coincident.direction(35));
  std::size_t gradients = 0;
  for (const EstimatorDescription& description : estimatorDescriptions()) {
    if (description.name.starts_with("hemicube")) continue;  // of another stratification
    SCOPED_TRACE(description.name);
    const auto estimator = makeEstimator(description.name, coincident.stratification, coincident.shape);
    const IrradianceEstimate estimate = estimator->estimate(coincident);
    const IrradianceEstimate neighbour = estimator->estimate(apart);
    EXPECT_TRUE(estimate.isFinite());
    // The result for samples next to each other, and not that of another record.
    if (estimate.gradient) {
      ++gradients;
      EXPECT_LE((*estimate.gradient - *neighbour.gradient).norm(), 1e-5 * neighbour.gradient->norm());
    }
    if (estimate.hessian) {
      EXPECT_LE((*estimate.hessian - *neighbour.hessian).norm(), 1e-4 * neighbour.hessian->norm());
    }
  }
  EXPECT_GE(gradients, 4U);
  EXPECT_TRUE(vectorIrradianceOfCells(apart).allFinite());
  EXPECT_FALSE(vectorIrradianceOfCells(coincident).allFinite());
}

/// The mistake: the distance of the nearest hit, where the split-sphere model means the harmonic mean of all.
double nearestDistance(const HemisphereSamples& samples) {
  return 1.0 / *std::max_element(samples.inverse_distance.begin(), samples.inverse_distance.end());
}

TEST(Regressions, NearestDistanceInPlaceOfTheHarmonicMean) {
  const Strata strata(Stratification::kConcentric, {64, 64});
  // Under a ceiling 2 m high the harmonic mean is 3 m: 1/pi int cos^2/2 dw = 1/3. With a wire in one of 4096 strata,
  // 1 cm away, 1/R is 1/3 + 100/4096.
  const auto mean = [&strata](const HemisphereSamples& samples) { return harmonicMeanDistance(samples, strata); };
  HemisphereSamples samples = sampleHemisphere(strata, SamplePattern::kCentred, 1, 0, kFrame, [](const Vector3d& w) {
    return RayHit{w(2) / 2.0, 1.0};
  });
  EXPECT_NEAR(mean(samples), 3.0, 0.01);
  EXPECT_GT(std::abs(nearestDistance(samples) - 3.0), 0.9);
  samples.inverse_distance[1234] = 100.0;
  const double with_wire = 1.0 / (1.0 / 3.0 + 100.0 / 4096.0);
  std::cout << "with a wire: harmonic mean " << mean(samples) << " m, nearest " << nearestDistance(samples) << " m\n";
  EXPECT_NEAR(mean(samples), with_wire, 0.01);
  EXPECT_NEAR(nearestDistance(samples), 0.01, 1e-12);
}

}  // namespace
}  // namespace irradiff
