#pragma once

#include "derivatives/boundary/vector.h"
#include "derivatives/scene/receiver.h"
#include "tests/mutants/formula_entry_points.h"

#include <vector>

namespace irradiff {

// Loops, not expressions of Eigen: every mutant compiles this.

using Vertices = std::vector<Vector3<double>>;

inline Vector3<double> vectorFrom(const double* components) { return {components[0], components[1], components[2]}; }

/// factor times the vector.
inline void write(const Vector3<double>& v, double factor, double* components) {
  for (int i = 0; i < 3; ++i) {
    components[i] = factor * v(i);
  }
}

/// factor times the matrix, row by row.
inline void write(const Matrix2<double>& m, double factor, double* entries) {
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      entries[2 * a + b] = factor * m(a, b);
    }
  }
}

/// factor times everything.
inline void write(double value, const Vector3<double>& gradient, const Matrix3<double>& hessian, double factor,
                  FormulaAnswer& answer) {
  answer.value = factor * value;
  write(gradient, factor, answer.gradient);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      answer.hessian[3 * i + j] = factor * hessian(i, j);
    }
  }
}

inline Vertices verticesFrom(const double* components, std::size_t count) {
  Vertices vertices;
  for (std::size_t i = 0; i < count; ++i) {
    vertices.push_back(vectorFrom(components + 3 * i));
  }
  return vertices;
}

inline Receiver receiverFrom(const double* position, const double* normal) {
  return {vectorFrom(position), vectorFrom(normal)};
}

}  // namespace irradiff
