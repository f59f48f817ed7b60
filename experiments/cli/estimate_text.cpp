#include "experiments/cli/estimate_text.h"

#include "experiments/cli/json_values.h"
#include "experiments/io/json_text.h"

#include <optional>

namespace irradiff {

namespace {

/// The reasons why fields are null.
class Reasons {
 public:
  explicit Reasons(std::string_view estimator) : estimator_(estimator) {}

  void add(const std::string& missing) { text_ += std::string(estimator_) + " " + missing + "; "; }
  /// With what holds for every estimator.
  std::string text() const { return text_ + "an estimate from samples has no error bound"; }

 private:
  std::string_view estimator_;
  std::string text_;
};

/// The text of a quantity, or null with its reason.
template <class Value, class MakeText>
std::string textOrNull(const std::optional<Value>& value, const std::string& missing, Reasons& reasons,
                       MakeText makeText) {
  if (value) return makeText(*value);
  reasons.add(missing);
  return "null";
}

}  // namespace

std::string estimateLine(std::string_view estimator, const SampleFrame& frame, const IrradianceEstimate& estimate) {
  const Eigen::Matrix3d axes = frame.axes();
  Reasons reasons(estimator);
  std::string text = R"({"results":[{"estimator":)" + jsonString(estimator) +
                     ",\"irradiance\":" + jsonNumber(estimate.irradiance, "irradiance");

  text += ",\"gradient\":" +
          textOrNull(estimate.gradient, "gives no gradient", reasons,
                     [&axes](const Eigen::Vector3d& gradient) { return jsonVector<3>(axes * gradient, "gradient"); });
  const bool is_normal_unknown = estimate.gradient && !estimate.knows_normal_component;
  if (is_normal_unknown) {
    reasons.add("knows the gradient in the tangent plane only, and \"gradient\" is that part of it");
  }
  text += ",\"gradient_normal_component\":" + (estimate.gradient && estimate.knows_normal_component
                                                   ? jsonNumber(estimate.gradient->z(), "gradient_normal_component")
                                                   : "null");

  // A Hessian in the tangent plane is all that most know of it.
  const std::string no_hessian =
      estimate.tangential_hessian ? "gives no Hessian but the tangential one" : "gives no Hessian";
  text += ",\"hessian\":" + textOrNull(estimate.hessian, no_hessian, reasons, [&axes](const Eigen::Matrix3d& hessian) {
            return jsonMatrix<3>(axes * hessian * axes.transpose(), "hessian");
          });
  text += ",\"tangential_hessian\":";
  if (estimate.tangential_hessian) {
    text += jsonMatrix<2>(*estimate.tangential_hessian, "tangential_hessian");
  } else {
    if (estimate.hessian) reasons.add("gives no tangential Hessian");
    text += "null";
  }
  text += ",\"rotational_gradient\":" + textOrNull(estimate.rotational_gradient, "gives no rotational gradient",
                                                   reasons, [&axes](const Eigen::Vector3d& gradient) {
                                                     return jsonVector<3>(axes * gradient, "rotational_gradient");
                                                   });
  return text +
         R"(,"error_bound":{"irradiance":null,"gradient":null,"hessian":null,"tangential_hessian":null,)"
         R"("rotational_gradient":null},"reason":)" +
         jsonString(reasons.text()) + "}]}";
}

}  // namespace irradiff
