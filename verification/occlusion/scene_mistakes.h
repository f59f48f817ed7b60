#pragma once

#include "verification/checks/candidate.h"
#include "verification/occlusion/occluded_scene.h"

#include <Eigen/Core>

#include <string>

namespace irradiff {

/// What usually makes a scene's quantity come out like this: occlusion ignored, a polygon or all black ones ignored,
/// apparent vertices held fixed, or what can be seen from the two values alone. Empty if nothing is recognised.
std::string likelyCause(Quantity quantity, const OccludedScene& scene, const Eigen::MatrixXd& expected,
                        const Eigen::MatrixXd& actual);

/// The input for people.
std::string inWords(const OccludedScene& scene);

}  // namespace irradiff
