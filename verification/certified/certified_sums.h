#pragma once

#include "derivatives/boundary/derivative_bounds.h"
#include "derivatives/boundary/irradiance.h"
#include "derivatives/form_factor/prepared_polygon.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "verification/certified/running_bound.h"
#include "verification/enclosure/ball.h"

namespace irradiff {

/// Irradiance and its derivatives at a scalar that carries its own errors, in units of 2^exponent metres.
template <class Scalar, int Dimension = 3>
struct CertifiedSums {
  IrradianceDerivatives<Scalar, Dimension> derivatives;
  DerivativeBounds sizes;  ///< of the terms that were added up, in the same units
  int exponent = 0;
};

// The scalars are a RunningBound of machine numbers, RunningBound<DoubleWord<double>> and Ball, the last at the working
// precision of the caller. All throw Undecided where that precision does not tell what has to be added up.

/// Of a polygon of radiance 1 of which something is seen, positive where its vertices run clockwise seen from the
/// receiver. The boundary form alone: no rule of quadrature, whose truncation would have to be bounded too. The machine
/// numbers are double, but for the angles behind irradiance and the rotational gradient.
template <class Scalar>
CertifiedSums<Scalar> polygonSums(const PreparedPolygon& prepared, const Receiver& receiver);

/// Of everything that is partly hidden, with the terms of the apparent vertices. The machine numbers are long double:
/// what is seen has cost more than a wider sum of it.
template <class Scalar>
CertifiedSums<Scalar> viewSums(const SceneMesh& mesh, const SceneComposition& scene, const Receiver& receiver);

}  // namespace irradiff
