#include "verification/enclosure/form_factor_enclosure.h"

#include <algorithm>

namespace irradiff {

double correctDigits(const FormFactorEnclosure& enclosure) {
  return std::min({normwiseDigits(Eigen::Matrix<Ball, 1, 1>(enclosure.value)), normwiseDigits(enclosure.gradient),
                   normwiseDigits(enclosure.hessian), normwiseDigits(enclosure.normal_gradient)});
}

}  // namespace irradiff
