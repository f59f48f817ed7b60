#include "experiments/cache/image_error.h"

#include "derivatives/scene/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {

ImageError imageError(std::span<const double> irradiance, std::span<const double> reference) {
  if (irradiance.size() != reference.size() || reference.empty()) {
    throw std::invalid_argument(std::to_string(irradiance.size()) + " values of irradiance and " +
                                std::to_string(reference.size()) +
                                " of its reference, must be as many of each and at least one");
  }
  double reference_sum = 0.0;
  std::vector<double> errors(reference.size());
  for (std::size_t i = 0; i < reference.size(); ++i) {
    errors[i] = std::abs(irradiance[i] - reference[i]);
    if (!std::isfinite(errors[i])) {
      throw std::invalid_argument("receiver " + std::to_string(i) + ": irradiance " + numberText(irradiance[i]) +
                                  " with the reference " + numberText(reference[i]) + ", both must be finite");
    }
    reference_sum += reference[i];
  }
  const auto count = static_cast<double>(reference.size());
  const double mean = reference_sum / count;
  if (!(mean > 0.0)) {
    throw std::invalid_argument("the mean of the reference is " + numberText(mean) + ", must be positive");
  }
  std::ranges::sort(errors);
  // 99 receivers of 100, in whole numbers.
  const std::size_t within = (99 * errors.size() + 99) / 100;
  // Of shares of the largest, whose squares neither overflow nor all underflow.
  const double largest = errors.back();
  double squares = 0.0;
  for (const double error : errors) {
    const double share = largest > 0.0 ? error / largest : 0.0;
    squares += share * share;
  }
  return {std::sqrt(squares / count) * (largest / mean), errors[within - 1] / mean, largest / mean};
}

}  // namespace irradiff
