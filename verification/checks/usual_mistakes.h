#pragma once

#include "verification/checks/candidate.h"
#include "verification/checks/error_diagnosis.h"

#include <string>
#include <vector>

namespace irradiff {

/// What mistakes that people make in such formulas would make of a polygon's quantity, computed from the library's own
/// terms: edges left out, counted twice or of the wrong sign, terms of the product rule left out, vertices not relative
/// to the receiver, local coordinates for world ones, a vector normalised or not ... `expected` is the right value.
std::vector<UsualMistake> usualMistakes(Quantity quantity, const Configuration& configuration,
                                        const Eigen::MatrixXd& expected);

/// What usually makes the quantity of the polygon come out like this; empty if nothing is recognised.
std::string likelyCause(Quantity quantity, const Configuration& configuration, const Eigen::MatrixXd& expected,
                        const Eigen::MatrixXd& actual);

/// The input for people: "4 vertices, 0.8 across, 1.3 away, 12 to 47 degrees above the horizon".
std::string inWords(const Configuration& configuration);

}  // namespace irradiff
