#pragma once

#include "derivatives/scene/receiver.h"
#include "derivatives/scene/segment.h"
#include "verification/checks/candidate.h"
#include "verification/checks/random.h"

#include <Eigen/Core>

#include <span>
#include <string>

namespace irradiff {

/// One input of a check in flatland: a segment of radiance 1 and a receiver.
struct FlatlandConfiguration {
  Segment segment;
  FlatlandReceiver receiver;
};

/// The configuration as one line of a scene file that `irradiff evaluate` reads; numbers read back to the same doubles.
std::string sceneLine(const FlatlandConfiguration& configuration);

/// What usually makes a quantity of the segment come out like this; empty if nothing is recognised.
std::string likelyCause(Quantity quantity, const FlatlandConfiguration& configuration, const Eigen::MatrixXd& expected,
                        const Eigen::MatrixXd& actual);

/// The input for people.
std::string inWords(const FlatlandConfiguration& configuration);

/// A family of seeded random inputs.
struct FlatlandFamily {
  const char* name;
  bool promises_digits;  ///< false where only the reported bound is promised
  FlatlandConfiguration (*draw)(KeyedRandom&);
};

/// Generic first; then short, near, nearly end-on and horizon-cut segments, and all of that at once.
std::span<const FlatlandFamily> flatlandFamilies();

/// (cos, sin).
Eigen::Vector2d directionAt(double angle);

/// Evenly in the square [-1, 1]^2.
Eigen::Vector2d drawPoint(KeyedRandom& random);

}  // namespace irradiff
