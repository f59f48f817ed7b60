#pragma once

#include <Eigen/Core>

#include <string>

namespace irradiff {

/// The shortest decimal text that reads back to the same double; "nan", "inf" and "-inf" for what is not finite.
std::string numberText(double value);

/// A point or direction as "(x, y, z)", each coordinate as numberText writes it.
std::string pointText(const Eigen::Ref<const Eigen::VectorXd>& point);

}  // namespace irradiff
