#include "experiments/cli/certified_text.h"

#include "experiments/cli/evaluation_text.h"
#include "verification/certified/ball_rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string_view>

namespace irradiff {

namespace {

/// A positive number as a decimal of two digits that is not below it.
std::string upperDecimal(long double bound) {
  std::array<char, 32> text{};
  // Two digits round by less than a twentieth.
  std::snprintf(text.data(), text.size(), "%.1Le", bound * 1.06L);
  return text.data();
}

/// The numbers of one quantity as decimals, and what they may be off. Sizes are long doubles: those of doubles at the
/// end of their range, times the tolerance, are below it.
class DecimalQuantity {
 public:
  template <class Matrix>
  DecimalQuantity(const Matrix& balls, double tolerance) {
    long double norm = 0.0L;
    for (Eigen::Index i = 0; i < balls.rows(); ++i) {
      for (Eigen::Index j = 0; j < balls.cols(); ++j) {
        norm = std::max(norm, std::abs(midpointInLongDouble(balls(i, j))));
        radius_ = std::max(radius_, radiusInLongDouble(balls(i, j)));
      }
    }
    // A tenth of it is lost to the last digit.
    resolution_ = std::max(radius_, tolerance * norm * 0x1p-10L);
    // Where long double is double.
    if (norm > 0.0L) resolution_ = std::max(resolution_, std::numeric_limits<long double>::min());
  }

  std::string text(const Ball& ball) const {
    const long double size = std::abs(midpointInLongDouble(ball));
    if (size == 0.0L) return "\"0\"";
    const long double digits = size > resolution_ ? std::log10(size / resolution_) + 2.0L : 2.0L;
    return "\"" + ball.midpointToDecimal(static_cast<int>(std::ceil(digits))) + "\"";
  }

  template <class Scalar, int Rows, int Columns>
  std::string text(const Eigen::Matrix<Scalar, Rows, Columns>& balls) const {
    std::string text = "[";
    for (int i = 0; i < Rows; ++i) {
      if (i > 0) text += ',';
      if constexpr (Columns == 1) {
        text += this->text(balls(i, 0));
      } else {
        text += '[';
        for (int j = 0; j < Columns; ++j) text += (j > 0 ? "," : "") + this->text(balls(i, j));
        text += ']';
      }
    }
    return text + "]";
  }

  /// Of the decimals: one unit of a last digit that is worth a tenth of the resolution, at most.
  std::string boundText() const { return "\"" + upperDecimal(radius_ + 0.1L * resolution_) + "\""; }

 private:
  long double radius_ = 0.0L;
  long double resolution_ = 0.0L;
};

/// Whether the doubles hold what the tolerance asks for.
template <int Dimension>
bool sufficesInDouble(const SceneEvaluation<Dimension>& evaluation, double tolerance) {
  const IrradianceDerivatives<double, Dimension>& d = evaluation.derivatives;
  const DerivativeBounds& bounds = evaluation.bounds;
  const auto largest = [](const auto& matrix) { return matrix.cwiseAbs().maxCoeff(); };
  return bounds.irradiance <= tolerance * d.irradiance.value &&
         bounds.rotational_gradient <= tolerance * std::max(d.irradiance.value, largest(d.rotational_gradient.value)) &&
         (!evaluation.no_gradient.empty() || bounds.gradient <= tolerance * largest(d.gradient.value)) &&
         (!evaluation.no_hessian.empty() || bounds.hessian <= tolerance * largest(d.hessian.value)) &&
         (!evaluation.no_tangential_hessian.empty() ||
          bounds.tangential_hessian <= tolerance * largest(d.tangential_hessian.value));
}

template <int Dimension>
std::string decimalText(const CertifiedScene<Dimension>& scene, double tolerance) {
  const SceneEvaluation<Dimension>& evaluation = scene.evaluation;
  const IrradianceDerivatives<Ball, Dimension>& balls = *scene.enclosure;
  const Eigen::Matrix<Ball, 1, 1> irradiance(balls.irradiance.value);
  std::string values;
  std::string bounds;
  const auto append = [&](std::string_view name, const std::string& reason, const auto& matrix, const auto& shaped) {
    const std::string key = std::string(values.empty() ? "" : ",") + "\"" + std::string(name) + "\":";
    const DecimalQuantity quantity(matrix, tolerance);
    values += key + (reason.empty() ? quantity.text(shaped) : "null");
    bounds += key + (reason.empty() ? quantity.boundText() : "null");
  };
  append("irradiance", evaluation.no_irradiance, irradiance, balls.irradiance.value);
  append("gradient", evaluation.no_gradient, balls.gradient.value, balls.gradient.value);
  append("hessian", evaluation.no_hessian, balls.hessian.value, balls.hessian.value);
  append("tangential_hessian", evaluation.no_tangential_hessian, balls.tangential_hessian.value,
         balls.tangential_hessian.value);
  append("rotational_gradient", evaluation.no_irradiance, balls.rotational_gradient.value,
         balls.rotational_gradient.value);
  return ",\"decimal\":{" + values + ",\"error_bound\":{" + bounds + "}}";
}

template <int Dimension>
std::string modelText(const CertifiedScene<Dimension>& scene) {
  std::string text = ",\"rungs\":{";
  for (const Rung rung : kRungs) {
    text += (rung == kRungs.front() ? "\"" : ",\"") + std::string(nameOf(rung)) +
            "\":" + std::to_string(scene.sources[static_cast<std::size_t>(rung)]);
  }
  return text + "},\"meets_tolerance\":" + (scene.misses_tolerance ? "false" : "true");
}

template <int Dimension>
void append(const CertifiedScene<Dimension>& scene, double tolerance, std::string& text) {
  const bool needs_decimals = scene.enclosure && !sufficesInDouble(scene.evaluation, tolerance);
  appendResult(scene.evaluation, nameOf(scene.rung()),
               {needs_decimals ? decimalText(scene, tolerance) : std::string(), modelText(scene)}, text);
}

}  // namespace

void appendCertifiedResult(const CertifiedScene<3>& scene, double tolerance, std::string& text) {
  append(scene, tolerance, text);
}

void appendCertifiedResult(const CertifiedScene<2>& scene, double tolerance, std::string& text) {
  append(scene, tolerance, text);
}

}  // namespace irradiff
