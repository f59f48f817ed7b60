#pragma once

#include "derivatives/error_metric/error_profile.h"
#include "experiments/cache/record_field.h"
#include "experiments/cache_3d/known_geometry.h"
#include "experiments/cache_3d/second_order.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace irradiff {

/// What the Hessian metrics take of a record with a share of the mean radiance added to what is seen (RecordEstimator).
struct MetricHessians {
  /// What relative errors are a share of: E, or in a black record E of radiance 1. W/m^2.
  double irradiance = 0.0;
  // In the frame of tangentFrame(normal); W/m^4.
  Eigen::Matrix2d radiometric = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d geometric = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d occlusion = Eigen::Matrix2d::Zero();
};

/// The shares of radiance that a choice may have, and the order of RecordKnowledge::hessians.
inline constexpr std::array<double, 2> kRadianceShares{0.0, 0.01};

/// What one gather tells of a receiver: the record that it may become, and what the published metrics take. World
/// coordinates where nothing else is said.
struct RecordKnowledge {
  double irradiance = 0.0;                                        ///< W/m^2
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();             ///< translational; W/m^3
  Eigen::Vector3d rotational_gradient = Eigen::Vector3d::Zero();  ///< with respect to a rotation vector
  double harmonic_mean_distance = 0.0;                            ///< m
  FirstOrder known_geometry;                                      ///< where the field offers it
  std::array<MetricHessians, kRadianceShares.size()> hessians;    ///< with each of kRadianceShares
};

/// Irradiance at a step in the tangent plane from a receiver beside what its record extrapolates to first order,
/// E(x + d) - E - g.d; W/m^2. Nothing where there is no receiver.
using RemainderAround = std::function<std::optional<double>(const Eigen::Vector2d& step)>;

/// What a field in space knows of its receivers, by their numbers. Functions may be called from several threads at
/// once.
struct FieldKnowledge {
  std::vector<Receiver> receivers;
  std::vector<double> pixel_sizes;
  std::function<RecordKnowledge(std::size_t)> record;
  bool offers_known_geometry = false;
  /// Errors of the record's extrapolation around it: predicted from what the record itself sees, and true ones. Of a
  /// record without light the former are the mean irradiance of the field times the share of the hemisphere,
  /// cosine-weighted, that it has not seen: it knows that there is a lamp, and not where.
  std::function<ErrorProfile(std::size_t)> reprojection;
  std::function<ErrorProfile(std::size_t)> oracle;
  /// How far the surface of a receiver reaches, m: no region of the oracle is larger. It would serve no one there, but
  /// receivers of other surfaces with the same normal, whose error no profile knows. Empty: everywhere.
  std::function<double(std::size_t)> reach;
  /// Relative errors of both are shares of no less than this: in the dark they would be shares of nothing. W/m^2,
  /// positive.
  double least_irradiance = 0.0;
  /// What is beside the first order around a receiver, as the record predicts it, and irradiance as it is. Empty where
  /// a field does not offer it: there is no metric "second-order" then, and true errors are taken from `oracle`.
  std::function<RemainderAround(std::size_t)> predicted;
  std::function<IrradianceAround(std::size_t)> truth;
  /// Where `predicted` and `truth` are asked for profiles: distances from each receiver, m, and the number of
  /// directions.
  std::function<std::vector<double>(std::size_t)> profile_distances;
  std::function<std::vector<double>(std::size_t)> true_distances;
  /// Adds to predicted errors what the record cannot predict since it does not see it. May be empty.
  std::function<void(std::size_t, ErrorProfile&)> add_unseen;
  std::size_t profile_directions = 16;

  double meanIrradiance() const;
};

/// FieldKnowledge::least_irradiance over the mean of the reference.
inline constexpr double kLeastIrradianceShare = 0.01;

inline double FieldKnowledge::meanIrradiance() const { return least_irradiance / kLeastIrradianceShare; }

/// In the order of tables: the published ones (errorMetricDescriptions()), "reprojection" and "oracle"; before the last
/// "second-order" if the field offers it.
std::vector<std::string> recordMetrics(bool has_second_order = false);

/// RecordField::records of a field in space: a record has the irradiance and gradients of its knowledge, and the region
/// that the metric gives it, within limits of the half-axes in pixels. One of `second-order` has a Hessian too, and the
/// quadratic's gradient (nearestQuadratic) over the region in which the second order at the receiver is predicted to
/// keep the threshold. A record that no light reaches keeps MetricChoice::black_pixels too, unless it is the oracle's.
/// Throws std::invalid_argument naming the metric and the option as ErrorMetric does, for a radiance share that is none
/// of kRadianceShares, and for known geometry where the field does not offer it.
RecordMaker recordMaker(std::shared_ptr<const FieldKnowledge> field, const MetricChoice& choice);

/// RecordField::true_error of a field in space.
std::function<double(std::size_t, const CacheRecord&)> trueError(std::shared_ptr<const FieldKnowledge> field);

}  // namespace irradiff
