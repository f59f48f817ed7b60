#pragma once

#include "verification/checks/verdict.h"

#include <cstdint>
#include <vector>

namespace irradiff {

// Properties that any right form factor has, whatever its formula. Each check draws its own seeded inputs and returns a
// verdict for each quantity that the candidate has. Errors are relative to the max norm of the quantity (of the
// rotational gradient and F together), or of the summands where the sum should vanish. `tolerance` is the candidate's
// promised relative error; each check allows as many of it as values enter the comparison.

/// A closed surface around the receiver fills its hemisphere: F sums to 1 and its derivatives to 0.
/// Parallelepipeds and tetrahedra at any orientation, so that polygons cross the horizon. For candidates that know the
/// horizon.
std::vector<Verdict> checkClosure(const Candidate& candidate, std::size_t inputs, std::uint64_t seed, double tolerance);

/// The parts of a polygon cut in two add up to it.
std::vector<Verdict> checkAdditivity(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                     double tolerance);

/// F and its rotational gradient are numbers, its gradient goes as 1/length and its Hessian as 1/length^2: scaled by 3,
/// which is no power of two.
std::vector<Verdict> checkScaling(const Candidate& candidate, std::size_t inputs, std::uint64_t seed, double tolerance);

/// F stays, the gradient turns and the Hessian turns on both sides with the scene. Rotations by integer quaternions,
/// exact on the inputs.
std::vector<Verdict> checkRotation(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                   double tolerance);

/// The mirror image at a coordinate plane, vertices in reverse order. Exact.
std::vector<Verdict> checkMirror(const Candidate& candidate, std::size_t inputs, std::uint64_t seed, double tolerance);

/// Vertices in reverse order change the sign of everything. Exact.
std::vector<Verdict> checkReversal(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                   double tolerance);

/// A_1 F_12 = A_2 F_21 for two polygons, F_12 by Gauss quadrature of the point form factor over polygon 1. F alone.
std::vector<Verdict> checkReciprocity(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                      double tolerance);

/// The Hessian, as it is before a candidate makes it symmetric, equals its transpose, and its trace is -1/pi sum n.(r x
/// e) int |p|^-4 dt, integrated numerically. Hessian alone.
std::vector<Verdict> checkSymmetryAndTrace(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                           double tolerance);

}  // namespace irradiff
