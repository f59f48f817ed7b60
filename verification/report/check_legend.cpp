#include "verification/report/check_legend.h"

#include <stdexcept>

namespace irradiff {

const std::vector<CheckExplanation>& checkLegend() {
  static const std::vector<CheckExplanation> legend = {
      {"area-integral enclosure", CheckKind::kValues,
       "A wrong F or derivative: rigorous enclosures of the defining area integral and of its kernel's "
       "derivatives, 40 digits. Shares nothing with the formulas.",
       "Receivers very near the polygon, where it takes too long."},
      {"reference data", CheckKind::kValues,
       "The same and rounding, at the hard places: 40-digit values made once by enclosures and 200-digit differences "
       "of "
       "the defining integral.",
       "Places where there is no case."},
      {"defining integral", CheckKind::kValues,
       "A wrong flatland irradiance: the definition by adaptive quadrature in long double.",
       "Derivatives; errors below its own estimate."},
      {"multiprecision", CheckKind::kValues, "Rounding, at any input: the same formula at 200 digits.",
       "A wrong formula: it would be wrong at 200 digits too."},
      {"nested Jets on F", CheckKind::kValues,
       "Wrong derivative algebra: F differentiated twice by nested Ceres Jets over the position, and once over the "
       "normal, at 200 digits.",
       "A wrong F."},
      {"Jets on the gradient", CheckKind::kValues,
       "A Hessian, whole or tangential, that is not the derivative of the gradient: first-order Ceres Jets, at 200 "
       "digits.",
       "A wrong gradient."},
      {"differences at 200 digits", CheckKind::kValues,
       "Wrong derivative algebra: differences of F at 200 digits with Ridders' extrapolation and its own error "
       "estimate.",
       "A wrong F."},
      {"claimed bound", CheckKind::kBounds,
       "An error above the bound that the formula itself reports, against the values of multiprecision or of the "
       "reference data.",
       "A bound that is needlessly large."},
      {"closed form", CheckKind::kConsistency,
       "A wrong F: configurations of Howell's catalogue of view factors, by number. From points (B) directly, "
       "from areas (C) as means by adaptive quadrature.",
       "Derivatives; other configurations."},
      {"closure", CheckKind::kConsistency,
       "A lost or doubled piece at the horizon, a wrong normalisation: a closed surface gives F = 1 and no "
       "derivatives.",
       "Errors that cancel around the receiver."},
      {"additivity", CheckKind::kConsistency, "Anything not additive: the parts of a polygon must add up to it.",
       "A wrong formula that is additive."},
      {"scaling", CheckKind::kConsistency,
       "Wrong powers of length, absolute thresholds: scaled by 3, gradient and Hessian go as 1/length and 1/length^2, "
       "the rotational gradient stays.",
       "Wrong factors without a unit."},
      {"rotation", CheckKind::kConsistency,
       "Swapped or lost coordinates: the scene is turned by rotations that are exact in double precision.",
       "A wrong formula made of scalar products."},
      {"mirror", CheckKind::kConsistency, "Signs that depend on handedness: the mirror image, exactly.",
       "A wrong formula without a preferred hand."},
      {"reversal", CheckKind::kConsistency, "Signs: vertices in reverse order change the sign of everything, exactly.",
       "An overall sign."},
      {"reciprocity", CheckKind::kConsistency,
       "A wrong dependence on distance or orientation: A1 F12 = A2 F21 by quadrature.",
       "Derivatives; a constant factor."},
      {"symmetry", CheckKind::kConsistency,
       "A Hessian that differs from its transpose before the library averages the two.", "A wrong symmetric one."},
      {"trace", CheckKind::kConsistency,
       "A Hessian of wrong trace: it is -1/pi sum n.(r x e) int |p|^-4 dt, integrated numerically.",
       "Errors of trace 0."},
      {"differences of its own form factor", CheckKind::kConsistency,
       "A gradient that does not belong to the formula's own F: differences in double precision with Ridders' "
       "extrapolation and its own error estimate. Needs no reference.",
       "Errors below that estimate; a wrong F."},
      {"differences of its own gradient", CheckKind::kConsistency,
       "A Hessian, whole or tangential, that does not belong to the formula's own gradient: likewise.",
       "Errors below that estimate; a wrong gradient."},
      {"differences over the normal", CheckKind::kConsistency,
       "A rotational gradient that does not belong to the formula's own F: likewise, the normal turned.",
       "Errors below that estimate; a wrong F."},
  };
  return legend;
}

const CheckExplanation& explanationOf(std::string_view check) {
  for (const CheckExplanation& explanation : checkLegend()) {
    const bool is_closed_form = explanation.check == "closed form" && check.starts_with("closed form");
    if (explanation.check == check || is_closed_form) {
      return explanation;
    }
  }
  throw std::invalid_argument("the report's legend does not explain the check '" + std::string(check) + "'");
}

}  // namespace irradiff
