#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "derivatives/boundary/irradiance.h"
#include "derivatives/scene/invalid_scene.h"
#include "derivatives/scene/receiver.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

namespace irradiff {

/// What became of a scene's sources, polygons or in flatland segments, at one receiver: each counts once, under the
/// first of these that is so.
struct SourceCounts {
  std::size_t own_surface = 0;    ///< the receiver lies on it: it is not there
  std::size_t below_horizon = 0;  ///< nothing of it rises above the horizon
  std::size_t edge_on = 0;        ///< the receiver lies in its plane, in flatland on its line
  std::size_t hidden = 0;         ///< others are nearer wherever it would be seen: skipped
  std::size_t black = 0;          ///< seen, and radiates nothing: skipped, though it may hide others
  std::size_t partly_hidden = 0;  ///< what is seen of it was summed over the boundary of the view
  std::size_t boundary = 0;       ///< seen whole: evaluated as if alone, along its boundary
  std::size_t area_rule = 0;      ///< the same, small compared with its distance: integrated over its area or length
};

/// Irradiance of a scene at one receiver with its derivatives, their bounds, and what the scene required.
/// Units: W/m^2, W/m^3, W/m^4 for radiance in W/(m^2 sr); one power of metre less in flatland.
template <int Dimension>
struct SceneEvaluation {
  IrradianceDerivatives<double, Dimension> derivatives;
  DerivativeBounds bounds;
  bool crosses_horizon = false;       ///< some radiating source was cut at the horizon
  bool has_occlusion = false;         ///< something above the horizon was hidden
  std::size_t apparent_vertices = 0;  ///< whose motion counts in the Hessian; none in flatland
  /// Nothing from an evaluator that treats all sources alike.
  std::optional<SourceCounts> sources;
  // Why a quantity has no value at the receiver; empty if it has. Its value and bound above are then meaningless.
  std::string no_irradiance;  ///< for the rotational gradient too; only the appendix form leaves these without a value
  std::string no_gradient;
  std::string no_hessian;
  std::string no_tangential_hessian;
};

/// A scene in which nothing radiates.
template <int Dimension>
SceneEvaluation<Dimension> darkScene() {
  SceneEvaluation<Dimension> sum;
  sum.derivatives.irradiance.value = 0.0;
  sum.derivatives.gradient.value.setZero();
  sum.derivatives.hessian.value.setZero();
  sum.derivatives.tangential_hessian.value.setZero();
  sum.derivatives.rotational_gradient.value.setZero();
  return sum;
}

/// Adds radiance times the derivatives of one source of radiance 1, and to the bounds the roundings of that product and
/// of the sums.
template <int Dimension>
void addSource(SceneEvaluation<Dimension>& sum, const IrradianceDerivatives<double, Dimension>& d,
               const DerivativeBounds& bounds, double radiance) {
  constexpr double kUnitRoundoff = 0x1p-53;
  // What the products with radiance lose below the normal range.
  constexpr double kUnderflow = 2.0 * std::numeric_limits<double>::denorm_min();
  IrradianceDerivatives<double, Dimension>& total = sum.derivatives;
  total.irradiance.value += radiance * d.irradiance.value;
  total.gradient.value += radiance * d.gradient.value;
  total.hessian.value += radiance * d.hessian.value;
  total.tangential_hessian.value += radiance * d.tangential_hessian.value;
  total.rotational_gradient.value += radiance * d.rotational_gradient.value;
  const auto addBound = [radiance](double& bound, double source_bound, double source_size, double total_size) {
    bound += radiance * source_bound + 2.0 * kUnitRoundoff * (radiance * source_size + total_size) + kUnderflow;
  };
  addBound(sum.bounds.irradiance, bounds.irradiance, std::abs(d.irradiance.value), std::abs(total.irradiance.value));
  addBound(sum.bounds.gradient, bounds.gradient, d.gradient.value.cwiseAbs().maxCoeff(),
           total.gradient.value.cwiseAbs().maxCoeff());
  addBound(sum.bounds.hessian, bounds.hessian, d.hessian.value.cwiseAbs().maxCoeff(),
           total.hessian.value.cwiseAbs().maxCoeff());
  addBound(sum.bounds.tangential_hessian, bounds.tangential_hessian, d.tangential_hessian.value.cwiseAbs().maxCoeff(),
           total.tangential_hessian.value.cwiseAbs().maxCoeff());
  addBound(sum.bounds.rotational_gradient, bounds.rotational_gradient,
           d.rotational_gradient.value.cwiseAbs().maxCoeff(), total.rotational_gradient.value.cwiseAbs().maxCoeff());
}

/// "the receiver at [x, y]", for messages.
template <int Dimension>
std::string describeReceiver(const ReceiverIn<Dimension>& receiver) {
  std::ostringstream text;
  text.precision(17);
  text << "the receiver at [";
  for (int i = 0; i < Dimension; ++i) {
    text << (i > 0 ? ", " : "") << receiver.position(i);
  }
  text << ']';
  return text.str();
}

/// Throws InvalidScene if a sum or a bound is not finite. describeSource() names what was added last.
template <int Dimension, class DescribeSource>
void requireFinite(const SceneEvaluation<Dimension>& sum, const ReceiverIn<Dimension>& receiver,
                   DescribeSource describeSource) {
  const IrradianceDerivatives<double, Dimension>& d = sum.derivatives;
  if (!std::isfinite(d.irradiance.value) || !d.gradient.value.allFinite() || !d.hessian.value.allFinite() ||
      !d.tangential_hessian.value.allFinite() || !d.rotational_gradient.value.allFinite() ||
      !std::isfinite(sum.bounds.irradiance) || !std::isfinite(sum.bounds.gradient) ||
      !std::isfinite(sum.bounds.hessian) || !std::isfinite(sum.bounds.tangential_hessian) ||
      !std::isfinite(sum.bounds.rotational_gradient)) {
    throw InvalidScene(describeSource() + " takes the sum over the scene's sources at " + describeReceiver(receiver) +
                       " beyond the range of double");
  }
}

}  // namespace irradiff
