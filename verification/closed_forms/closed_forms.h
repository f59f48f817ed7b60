#pragma once

#include "derivatives/scene/polygon.h"
#include "derivatives/scene/receiver.h"

#include <Eigen/Core>
#include <boost/multiprecision/mpfr.hpp>

#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace irradiff {

// Closed forms of form factors as an oracle: each entry is a formula from a catalogue and the scene that it describes.
//
//     for (const ClosedForm& form : closedForms()) {
//       const std::vector<double> parameters = ...;                    // inside form.parameters
//       const auto [polygon, receiver] = form.configuration(parameters);
//       compare(myFormFactor(polygon, receiver), form.value(parameters), form.configuration_error);
//     }
//
// The formulas themselves, for any scalar type, are in closed_form_formulas.h. docs/closed_forms.md says which
// catalogue numbers were checked, and against what.

/// Number type in which closed forms are evaluated: 100 decimal digits.
using HundredDigits =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<100>, boost::multiprecision::et_off>;

/// A parameter of a closed form and the values it may take, both ends included. Lengths in metres unless the title says
/// otherwise. Every point of the box of all ranges is a valid configuration.
struct ParameterRange {
  std::string_view name;
  double lower = 0.0;
  double upper = 0.0;
  bool integer = false;
};

/// One entry of the oracle. `Receiving` is Receiver or ReceivingParallelogram.
///
/// The three functions take as many finite values as there are parameters, each in its range, and otherwise throw
/// std::invalid_argument that names the entry, the parameter, its value and the rule.
template <class Receiving>
struct CatalogueEntry {
  /// Number in J. R. Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", 3rd edition; empty where the
  /// catalogue's number is not known to us.
  std::string_view catalogue_number;
  std::string_view title;
  /// Where the formula is from.
  std::string_view source;
  std::vector<ParameterRange> parameters;
  /// Form factor, rounded from 100 digits: off by at most half an ulp over the ranges.
  std::function<double(std::span<const double>)> value;
  std::function<HundredDigits(std::span<const double>)> value_at_100_digits;
  /// The polygon, named by the title, with radiance 1, clockwise seen from the receiver; and the receiver.
  std::function<std::pair<Polygon, Receiving>(std::span<const double>)> configuration;
  /// Bound on |F of the configuration / value - 1| in exact arithmetic: 0 where the configuration is the one of the
  /// formula to the last bit, which holds for parameters of at most 20 significant bits; rounding of the vertices or
  /// the cut of an infinite strip elsewhere.
  double configuration_error = 0.0;
};

using ClosedForm = CatalogueEntry<Receiver>;

/// The area A1 of a form factor between areas: corner + s edge_u + t edge_v, s and t in [0, 1], with unit normal
/// `normal`. F12 is the mean over s and t of the form factor of the receiver there.
struct ReceivingParallelogram {
  Eigen::Vector3d corner;
  Eigen::Vector3d edge_u;
  Eigen::Vector3d edge_v;
  Eigen::Vector3d normal;
  /// Whether that form factor is analytic up to the boundary of A1, so that Gauss-Legendre quadrature converges
  /// geometrically. Where it is not, it has a kink at the ends of a common edge.
  bool smooth = true;
};

using ClosedFormBetweenAreas = CatalogueEntry<ReceivingParallelogram>;

/// Closed forms from a receiver to a polygon. The whole polygon is on or above the receiver's horizon.
std::span<const ClosedForm> closedForms();

/// Closed forms from a finite area to a polygon.
std::span<const ClosedFormBetweenAreas> closedFormsBetweenAreas();

}  // namespace irradiff
