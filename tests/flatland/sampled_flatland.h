#pragma once

#include "derivatives/flatland/flatland_estimate.h"
#include "derivatives/flatland/flatland_samples.h"
#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace irradiff {

/// A ray query that intersects every segment with the ray; keeps references.
FlatlandRayQuery rayCaster(std::span<const Segment> scene, const FlatlandReceiver& receiver);

FlatlandSamples sampleCentred(const FlatlandStrata& strata, const FlatlandRayQuery& cast_ray);
/// Independent and uniform in each stratum.
FlatlandSamples sampleJittered(const FlatlandStrata& strata, std::uint64_t seed, const FlatlandRayQuery& cast_ray);

/// evaluateScene() in the frame of the receiver. Fails the test if a derivative does not exist.
FlatlandEstimate trueEstimate(std::span<const Segment> scene, const FlatlandReceiver& receiver);

/// A lamp and two blockers, one dark and one dim, any of which may hide another's end, in a room of two radiances whose
/// walls continue below.
std::vector<Segment> furnishedRoom();
/// Nothing hides anything.
std::vector<Segment> tiltedLamp();
/// Parallel to the tangent of upright receivers and seen through the top of the square alone.
std::vector<Segment> levelLamp();
/// The walls and the ceiling, all of one radiance, of the room |x| <= 1, 0 <= y <= 2.
std::vector<Segment> flatRoom(double radiance);

/// At y = 0, |x| <= 1/2, the normal up to `tilt` radians from upright.
std::vector<FlatlandReceiver> flatlandReceivers(std::size_t count, double tilt);

/// Median relative errors over receivers, on finer and finer strata with jittered samples or with more and more rays.
struct FlatlandConvergence {
  std::string what;
  std::vector<std::size_t> sizes;
  std::vector<double> errors;

  /// The slope of the least-squares line through log(size) and -log(error).
  double order() const;

  /// An edge is found to within a stratum, so that an error of first order in 1/N remains at worst. 3/4 of that is
  /// asked for, which a bias does not reach: from 64 to 4096 the errors must fall to 0.044.
  bool isReached() const { return order() >= 0.75; }
};

std::ostream& operator<<(std::ostream& out, const FlatlandConvergence& convergence);

using FlatlandEstimateOf = std::function<FlatlandEstimate(const FlatlandSamples&)>;
using FlatlandErrorOf = std::function<double(const FlatlandEstimate&, const FlatlandEstimate& truth)>;
using FlatlandTruthOf = std::function<FlatlandEstimate(std::span<const Segment>, const FlatlandReceiver&)>;

/// What is sampled how: strata of N, a scene, receivers with tilted normals or upright ones.
struct FlatlandCase {
  FlatlandStratification stratification = FlatlandStratification::kCosine;
  std::vector<Segment> scene = furnishedRoom();
  double tilt = 0.3;
};

FlatlandConvergence flatlandConvergence(const std::string& what, const FlatlandCase& setting,
                                        const FlatlandEstimateOf& estimate, const FlatlandErrorOf& error,
                                        const FlatlandTruthOf& truth = trueEstimate);

/// Of two estimates' quantities, relative to the second.
double gradientDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth);
double tangentialGradientDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth);
double hessianDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth);
double tangentialHessianDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth);
double irradianceDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth);
double rotationalDifference(const FlatlandEstimate& estimate, const FlatlandEstimate& truth);

}  // namespace irradiff
