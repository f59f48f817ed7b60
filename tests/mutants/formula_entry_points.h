#pragma once

#include <cstddef>

// What a shared object with mutated formulas offers: plain numbers in and out, so that the program that loads it shares
// no type, template or inline function with it and both keep their own.

/// Which polygon formula of derivatives/ is asked for.
enum class PolygonFormula : int {
  kProduction,          ///< evaluatePolygon, its irradiance turned into the signed form factor
  kBoundaryForm,        ///< boundaryFormFactor<double>
  kEdgeTerms,           ///< the sum of arcTerms over the arcs, before the Hessian is symmetrised; F of kBoundaryForm
  kAppendixArccos,      ///< appendixFormFactor, vertices relative to the receiver in double
  kAppendixArctangent,  ///< the same with the angle by atan2
};

/// F (1), its gradient (1/m) and Hessian (1/m^2), row by row; for kProduction and kEdgeTerms also the tangential
/// Hessian and the rotational gradient of F, and for kProduction the claimed bounds of their errors, in the order of
/// DerivativeBounds. In flatland irradiance, the first two components of the gradient, the first four of the Hessian
/// and the first of the tangential Hessian and of the rotational gradient.
struct FormulaAnswer {
  double value;
  double gradient[3];
  double hessian[9];
  double tangential_hessian[4];
  double rotational_gradient[3];
  double bounds[5];
};

extern "C" {

/// `vertices` holds x, y, z of each of `vertex_count` vertices. Returns false if the formula throws.
[[gnu::visibility("default")]] bool answerPolygon(PolygonFormula formula, const double* vertices,
                                                  std::size_t vertex_count, const double* position,
                                                  const double* normal, FormulaAnswer* answer);

/// The same for evaluateSegment; `vertices` holds x, y of both ends.
[[gnu::visibility("default")]] bool answerSegment(const double* vertices, const double* position, const double* normal,
                                                  FormulaAnswer* answer);

/// The same for SceneEvaluator: irradiance, and NaN for a derivative that does not exist. `vertices` holds those of one
/// polygon after the other, `vertex_counts` and `radiances` are of each of `polygon_count` polygons.
[[gnu::visibility("default")]] bool answerScene(const double* vertices, const std::size_t* vertex_counts,
                                                const double* radiances, std::size_t polygon_count,
                                                const double* position, const double* normal, FormulaAnswer* answer);
}
