#include "derivatives/flatland/flatland_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>

namespace irradiff {

void requireFinite(std::string_view name, const FlatlandEstimate& estimate, std::span<const FlatlandHit> hits) {
  if (std::isfinite(estimate.irradiance) && std::isfinite(estimate.rotational_gradient) &&
      (!estimate.gradient || estimate.gradient->allFinite()) && (!estimate.hessian || estimate.hessian->allFinite()) &&
      (!estimate.tangential_hessian || std::isfinite(*estimate.tangential_hessian))) {
    return;
  }
  const auto largestBy = [hits](double FlatlandHit::*member) {
    return static_cast<std::size_t>(
        std::max_element(hits.begin(), hits.end(),
                         [member](const FlatlandHit& a, const FlatlandHit& b) { return a.*member < b.*member; }) -
        hits.begin());
  };
  const std::size_t nearest = largestBy(&FlatlandHit::inverse_distance);
  const std::size_t brightest = largestBy(&FlatlandHit::radiance);
  std::ostringstream message;
  message << "flatland estimator " << name << ": the result is beyond the range of double; the nearest hit is number "
          << nearest << " with inverse distance " << hits[nearest].inverse_distance << ", the brightest is number "
          << brightest << " with radiance " << hits[brightest].radiance;
  throw std::overflow_error(message.str());
}

}  // namespace irradiff
