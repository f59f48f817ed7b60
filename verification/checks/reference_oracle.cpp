#include "verification/checks/reference_oracle.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace irradiff {
namespace {

Configuration configurationOf(const ReferenceCase& c) { return {c.polygon, c.receiver}; }

/// Whether 20 digits are known. Almost at the horizon the tangential Hessian may be smaller than the last digits of the
/// Hessian that it is projected from.
bool hasDigits(const Matrix2<Multiprecision>& value, double uncertainty) {
  Multiprecision norm = 0;
  for (Eigen::Index i = 0; i < value.size(); ++i) {
    norm = std::max<Multiprecision>(norm, abs(value(i)));
  }
  return uncertainty <= Multiprecision("1e-20") * norm;
}

}  // namespace

ReferenceOracle::ReferenceOracle(const std::filesystem::path& folder) : cases_(readReferenceData(folder)) {
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    const Configuration configuration = configurationOf(cases_[i]);
    case_of_line_.emplace(sceneLine(configuration), i);
    inputs_[cases_[i].family].push_back(configuration);
  }
}

Oracle ReferenceOracle::oracle() const {
  return {"reference data",
          "a wrong F or derivative, and rounding: shares nothing with the formulas",
          {kQuantities.begin(), kQuantities.end()},
          [this](const Configuration& configuration) -> std::optional<OracleValue> {
            const auto found = case_of_line_.find(sceneLine(configuration));
            if (found == case_of_line_.end()) {
              return std::nullopt;
            }
            const ReferenceCase& c = cases_[found->second];
            OracleValue value;
            value.form_factor = Multiprecision(c.value.decimal);
            for (int i = 0; i < 3; ++i) {
              value.gradient(i) = Multiprecision(c.gradient(i).decimal);
              for (int j = 0; j < 3; ++j) {
                value.hessian(i, j) = Multiprecision(c.hessian(i, j).decimal);
              }
            }
            value.form_factor_uncertainty = std::strtod(c.error.value.c_str(), nullptr);
            value.gradient_uncertainty = std::strtod(c.error.gradient.c_str(), nullptr);
            value.hessian_uncertainty = std::strtod(c.error.hessian.c_str(), nullptr);
            value.projectHessian(configuration);
            if (!hasDigits(value.tangential_hessian, value.tangential_hessian_uncertainty)) {
              value.tangential_hessian_uncertainty = std::numeric_limits<double>::infinity();
            }
            for (int i = 0; i < 3; ++i) {
              value.rotational_gradient(i) = Multiprecision(c.rotational_gradient(i).decimal);
            }
            value.rotational_gradient_uncertainty = std::strtod(c.error.rotational_gradient.c_str(), nullptr);
            return value;
          }};
}

}  // namespace irradiff
