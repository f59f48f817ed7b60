#pragma once

#include <Eigen/Core>

#include <cstddef>

namespace irradiff {

/// Where irradiance arrives: a point (metres) and the unit normal of the surface there, in 3D or in flatland.
/// The normal is used as given; | |n| - 1 | must be at most kUnitNormalTolerance.
template <int Dimension>
struct ReceiverIn {
  Eigen::Matrix<double, Dimension, 1> position;
  Eigen::Matrix<double, Dimension, 1> normal;
};

using Receiver = ReceiverIn<3>;
using FlatlandReceiver = ReceiverIn<2>;

inline constexpr double kUnitNormalTolerance = 1e-12;

/// Throws InvalidScene naming the receiver by `index`, the value and the rule, unless position and normal are finite
/// and the normal has unit length within kUnitNormalTolerance.
void validate(const Receiver& receiver, std::size_t index);
void validate(const FlatlandReceiver& receiver, std::size_t index);

}  // namespace irradiff
