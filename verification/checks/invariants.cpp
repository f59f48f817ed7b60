#include "verification/checks/invariants.h"

#include "derivatives/boundary/irradiance.h"
#include "verification/checks/input_families.h"
#include "verification/checks/random.h"
#include "verification/checks/verdict_builder.h"

#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace irradiff {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

double maxNorm(const MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

/// What an error is relative to, as in checkAgainst.
double sizeOf(const Candidate& candidate, Quantity quantity, const Configuration& input, const MatrixXd& value) {
  const bool is_part = quantity == Quantity::kRotationalGradient && candidate.form_factor;
  return is_part ? std::max(maxNorm(value), std::abs(candidate.form_factor(input))) : maxNorm(value);
}

Configuration withVertices(const Configuration& configuration, std::vector<Vector3d> vertices) {
  Configuration result = configuration;
  result.polygon.vertices = std::move(vertices);
  return result;
}

/// What becomes of a value when position and polygon are moved by the orthogonal `turn` and enlarged by `scale`, from a
/// receiver with normal `before` to one with normal `after`. The rotational gradient is an axial vector, and the
/// tangential Hessian is in the frame of its receiver.
MatrixXd moved(Quantity quantity, const MatrixXd& value, const Matrix3d& turn, double scale, const Vector3d& before,
               const Vector3d& after) {
  switch (quantity) {
    case Quantity::kFormFactor:
      return value;
    case Quantity::kGradient:
      return turn * value / scale;
    case Quantity::kHessian:
      return turn * value * turn.transpose() / (scale * scale);
    case Quantity::kTangentialHessian: {
      const Eigen::Matrix2d frame_turn = tangentFrame<double>(after).transpose() * turn * tangentFrame<double>(before);
      return frame_turn * value * frame_turn.transpose() / (scale * scale);
    }
    case Quantity::kRotationalGradient:
      return turn.determinant() * turn * value;
    case Quantity::kIrradiance:
      break;
  }
  return {};
}

/// Runs `compare(quantity, configuration, builder)` for each quantity over the inputs.
template <class Compare>
std::vector<Verdict> forEachQuantity(const Candidate& candidate, const char* check, const char* family,
                                     const std::vector<Configuration>& inputs, double tolerance, const char* rule,
                                     const Compare& compare) {
  std::vector<Verdict> verdicts;
  for (const Quantity quantity : kQuantities) {
    if (!candidate.has(quantity)) {
      continue;
    }
    VerdictBuilder builder(candidate.name, check, family, quantity, tolerance, rule);
    for (const Configuration& input : inputs) {
      builder.attempt(input, [&] { compare(quantity, input, builder); });
    }
    verdicts.push_back(builder.finish());
  }
  return verdicts;
}

/// Checks that evaluating the transformed input gives the transformed value.
template <class TransformInput, class TransformValue>
std::vector<Verdict> checkEquivariance(const Candidate& candidate, const char* check, std::size_t count,
                                       std::uint64_t seed, double tolerance, const TransformInput& transform_input,
                                       const TransformValue& transform_value) {
  const std::vector<Configuration> inputs = drawInputs(inputFamily("well-conditioned"), count, seed);
  return forEachQuantity(
      candidate, check, "well-conditioned", inputs, 2.0 * tolerance, "the promise, for each of 2 evaluations",
      [&](Quantity quantity, const Configuration& input, VerdictBuilder& builder) {
        const Configuration transformed = transform_input(input);
        const MatrixXd expected = transform_value(quantity, candidate.evaluate(quantity, input), input, transformed);
        const MatrixXd actual = candidate.evaluate(quantity, transformed);
        builder.add(maxNorm(actual - expected) / sizeOf(candidate, quantity, transformed, expected), 0.0, transformed,
                    expected, actual);
      });
}

/// A closed surface: faces with their vertices clockwise seen from inside.
std::vector<std::vector<Vector3d>> drawClosedSurface(KeyedRandom& random) {
  if (random.below(2) == 0) {
    // A parallelepiped spanned by vectors with few bits, so that its faces are planar to the last bit.
    std::array<Vector3d, 3> axis;
    do {
      for (Vector3d& a : axis) {
        a = random.direction().unaryExpr([](double v) { return std::ldexp(std::round(std::ldexp(v, 12)), -12); });
      }
    } while (axis[0].cross(axis[1]).dot(axis[2]) < 0.3);
    std::vector<std::vector<Vector3d>> faces;
    for (int k = 0; k < 3; ++k) {
      const Vector3d& n = axis[static_cast<std::size_t>(k)];
      const Vector3d& u = axis[static_cast<std::size_t>((k + 1) % 3)];
      const Vector3d& v = axis[static_cast<std::size_t>((k + 2) % 3)];
      faces.push_back({n - u - v, n + u - v, n + u + v, n - u + v});
      faces.push_back({-n - u - v, -n - u + v, -n + u + v, -n + u - v});
    }
    return faces;
  }
  std::array<Vector3d, 4> corner;
  do {
    for (Vector3d& c : corner) {
      c = random.direction() * random.between(0.8, 1.5);
    }
    const Vector3d a = corner[1] - corner[0];
    const Vector3d b = corner[2] - corner[0];
    const Vector3d c = corner[3] - corner[0];
    if (a.cross(b).dot(c) > 0.0) {
      std::swap(corner[1], corner[2]);
    }
    // The receiver is within 0.05 of the origin, which must be well inside.
    const auto inside = [](const Vector3d& p, const Vector3d& q, const Vector3d& r) {
      const Vector3d area = (q - p).cross(r - p);
      return p.dot(area) > 0.15 * area.norm();
    };
    if (inside(corner[0], corner[1], corner[2]) && inside(corner[0], corner[2], corner[3]) &&
        inside(corner[0], corner[3], corner[1]) && inside(corner[1], corner[3], corner[2])) {
      break;
    }
  } while (true);
  return {{corner[0], corner[1], corner[2]},
          {corner[0], corner[2], corner[3]},
          {corner[0], corner[3], corner[1]},
          {corner[1], corner[3], corner[2]}};
}

/// Rotation matrix of an integer quaternion times its norm: integers, so that products with short dyadic numbers are
/// exact.
struct IntegerRotation {
  Matrix3d matrix;
  double scale;
};

IntegerRotation drawIntegerRotation(KeyedRandom& random) {
  double w = 0.0;
  Vector3d v = Vector3d::Zero();
  do {
    w = static_cast<double>(random.below(9)) - 4.0;
    v = {static_cast<double>(random.below(9)) - 4.0, static_cast<double>(random.below(9)) - 4.0,
         static_cast<double>(random.below(9)) - 4.0};
  } while (w * w + v.squaredNorm() < 4.0);
  Matrix3d cross_matrix;
  cross_matrix << 0.0, -v(2), v(1), v(2), 0.0, -v(0), -v(1), v(0), 0.0;
  const double scale = w * w + v.squaredNorm();
  const Matrix3d matrix =
      (w * w - v.squaredNorm()) * Matrix3d::Identity() + 2.0 * v * v.transpose() + 2.0 * w * cross_matrix;
  return {matrix, scale};
}

std::vector<Vector3d> reversed(const std::vector<Vector3d>& vertices) { return {vertices.rbegin(), vertices.rend()}; }

double areaOf(const std::vector<Vector3d>& vertices) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    sum += (vertices[i] - vertices[0]).cross(vertices[i + 1] - vertices[0]);
  }
  return 0.5 * sum.norm();
}

/// The mean of the form factor to `target` over the triangle, by tensor Gauss-Legendre quadrature with Points points a
/// side.
template <unsigned Points>
double meanOverTriangle(const Candidate& candidate, const std::vector<Vector3d>& triangle, const Vector3d& normal,
                        const std::vector<Vector3d>& target) {
  using Rule = boost::math::quadrature::gauss<double, Points>;
  const auto inner = [&](double s) {
    return Rule::integrate(
        [&](double t) {
          const Vector3d x = triangle[0] + s * ((triangle[1] - triangle[0]) + t * (triangle[2] - triangle[1]));
          return 2.0 * s * std::abs(candidate.form_factor({{"target", target, 1.0}, {x, normal}}));
        },
        0.0, 1.0);
  };
  return Rule::integrate(inner, 0.0, 1.0);
}

}  // namespace

std::vector<Verdict> checkClosure(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                  double tolerance) {
  std::vector<Verdict> verdicts;
  for (const Quantity quantity : kQuantities) {
    if (!candidate.has(quantity)) {
      continue;
    }
    VerdictBuilder builder(candidate.name, "closure", "closed surfaces", quantity, 6.0 * tolerance,
                           "the promise, for each of up to 6 faces, relative to the largest face");
    for (std::size_t i = 0; i < inputs; ++i) {
      KeyedRandom random(seed, "closure", i);
      const std::vector<std::vector<Vector3d>> faces = drawClosedSurface(random);
      const Receiver receiver{0.05 * random.direction(), random.direction()};
      const Configuration first{{"face", faces[0], 1.0}, receiver};
      builder.attempt(first, [&] {
        MatrixXd sum;
        double largest = 0.0;
        for (const std::vector<Vector3d>& face : faces) {
          const MatrixXd part = candidate.evaluate(quantity, withVertices(first, face));
          sum = sum.size() == 0 ? part : MatrixXd(sum + part);
          largest = std::max(largest, sizeOf(candidate, quantity, withVertices(first, face), part));
        }
        MatrixXd expected = MatrixXd::Zero(sum.rows(), sum.cols());
        if (quantity == Quantity::kFormFactor) {
          expected(0, 0) = receiver.normal.norm();
        }
        builder.add(maxNorm(sum - expected) / largest, 0.0, first, expected, sum);
      });
    }
    verdicts.push_back(builder.finish());
  }
  return verdicts;
}

std::vector<Verdict> checkAdditivity(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                     double tolerance) {
  // Parallelograms, cut by a line between the midpoints of opposite sides, exactly. About one in five of the family is
  // one.
  std::vector<Configuration> whole;
  for (const Configuration& input : drawInputs(inputFamily("generic"), 20 * inputs, seed)) {
    if (input.polygon.vertices.size() == 4 && whole.size() < inputs) {
      whole.push_back(input);
    }
  }
  return forEachQuantity(
      candidate, "additivity", "generic", whole, 3.0 * tolerance,
      "the promise, for each of 3 evaluations, relative to the largest (form factor, rotational gradient: to 1)",
      [&](Quantity quantity, const Configuration& input, VerdictBuilder& builder) {
        const std::vector<Vector3d>& v = input.polygon.vertices;
        const Vector3d first_cut = 0.5 * (v[0] + v[1]);
        const Vector3d second_cut = 0.5 * (v[2] + v[3]);
        const MatrixXd expected = candidate.evaluate(quantity, input);
        const MatrixXd left = candidate.evaluate(quantity, withVertices(input, {v[0], first_cut, second_cut, v[3]}));
        const MatrixXd right = candidate.evaluate(quantity, withVertices(input, {first_cut, v[1], v[2], second_cut}));
        // A form factor is a fraction of 1, and only to that fraction is it promised: seen at a grazing angle it is a
        // small difference. So is the rotational gradient.
        const double largest = quantity == Quantity::kFormFactor || quantity == Quantity::kRotationalGradient
                                   ? 1.0
                                   : std::max({maxNorm(expected), maxNorm(left), maxNorm(right)});
        builder.add(maxNorm(left + right - expected) / largest, 0.0, input, expected, left + right);
      });
}

std::vector<Verdict> checkScaling(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                  double tolerance) {
  return checkEquivariance(
      candidate, "scaling", inputs, seed, tolerance,
      [](const Configuration& input) {
        Configuration result = input;
        for (Vector3d& v : result.polygon.vertices) {
          v *= 3.0;
        }
        result.receiver.position *= 3.0;
        return result;
      },
      [](Quantity quantity, const MatrixXd& value, const Configuration& before,
         const Configuration& after) -> MatrixXd {
        return moved(quantity, value, Matrix3d::Identity(), 3.0, before.receiver.normal, after.receiver.normal);
      });
}

std::vector<Verdict> checkRotation(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                   double tolerance) {
  const std::vector<Configuration> drawn = drawInputs(inputFamily("well-conditioned"), inputs, seed);
  std::vector<Verdict> verdicts;
  for (const Quantity quantity : kQuantities) {
    if (!candidate.has(quantity)) {
      continue;
    }
    VerdictBuilder builder(candidate.name, "rotation", "well-conditioned", quantity, 2.0 * tolerance,
                           "the promise, for each of 2 evaluations");
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      KeyedRandom random(seed, "rotation", i);
      const IntegerRotation rotation = drawIntegerRotation(random);
      Configuration rotated = drawn[i];
      for (Vector3d& v : rotated.polygon.vertices) {
        v = rotation.matrix * v;
      }
      rotated.receiver.position = rotation.matrix * rotated.receiver.position;
      rotated.receiver.normal = (rotation.matrix * rotated.receiver.normal / rotation.scale).normalized();
      builder.attempt(rotated, [&] {
        const MatrixXd value = candidate.evaluate(quantity, drawn[i]);
        const MatrixXd expected = moved(quantity, value, rotation.matrix / rotation.scale, rotation.scale,
                                        drawn[i].receiver.normal, rotated.receiver.normal);
        const MatrixXd actual = candidate.evaluate(quantity, rotated);
        builder.add(maxNorm(actual - expected) / sizeOf(candidate, quantity, rotated, expected), 0.0, rotated, expected,
                    actual);
      });
    }
    verdicts.push_back(builder.finish());
  }
  return verdicts;
}

std::vector<Verdict> checkMirror(const Candidate& candidate, std::size_t inputs, std::uint64_t seed, double tolerance) {
  return checkEquivariance(
      candidate, "mirror", inputs, seed, tolerance,
      [](const Configuration& input) {
        Configuration result = withVertices(input, reversed(input.polygon.vertices));
        for (Vector3d& v : result.polygon.vertices) {
          v(0) = -v(0);
        }
        result.receiver.position(0) = -result.receiver.position(0);
        result.receiver.normal(0) = -result.receiver.normal(0);
        return result;
      },
      [](Quantity quantity, const MatrixXd& value, const Configuration& before,
         const Configuration& after) -> MatrixXd {
        return moved(quantity, value, Vector3d(-1.0, 1.0, 1.0).asDiagonal(), 1.0, before.receiver.normal,
                     after.receiver.normal);
      });
}

std::vector<Verdict> checkReversal(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                   double tolerance) {
  return checkEquivariance(
      candidate, "reversal", inputs, seed, tolerance,
      [](const Configuration& input) { return withVertices(input, reversed(input.polygon.vertices)); },
      [](Quantity, const MatrixXd& value, const Configuration&, const Configuration&) -> MatrixXd { return -value; });
}

std::vector<Verdict> checkReciprocity(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                      double tolerance) {
  if (!candidate.form_factor) {
    return {};
  }
  VerdictBuilder builder(candidate.name, "reciprocity", "facing triangles", Quantity::kFormFactor, 2.0 * tolerance,
                         "the promise, for each side, above the quadrature's own error");
  for (std::size_t i = 0; i < inputs; ++i) {
    KeyedRandom random(seed, "reciprocity", i);
    std::array<std::vector<Vector3d>, 2> triangle;
    std::array<Vector3d, 2> normal;
    for (std::size_t k = 0; k < 2; ++k) {
      const double z = k == 0 ? 0.0 : 2.0;
      for (const double angle : {0.0, 2.0, 4.0}) {
        triangle[k].push_back({0.5 * std::cos(angle) + random.between(-0.1, 0.1),
                               0.5 * std::sin(angle) + random.between(-0.1, 0.1), z + random.between(-0.2, 0.2)});
      }
      normal[k] =
          (triangle[k][1] - triangle[k][0]).cross(triangle[k][2] - triangle[k][0]).normalized() * (k == 0 ? 1.0 : -1.0);
    }
    const Configuration input{{"target", triangle[1], 1.0}, {triangle[0][0], normal[0]}};
    builder.attempt(input, [&] {
      const auto exchange = [&]<unsigned Points>(std::size_t from) {
        return areaOf(triangle[from]) *
               meanOverTriangle<Points>(candidate, triangle[from], normal[from], triangle[1 - from]);
      };
      const double there = exchange.template operator()<12>(0);
      const double back = exchange.template operator()<12>(1);
      const double coarse =
          std::abs(exchange.template operator()<8>(0) - there) + std::abs(exchange.template operator()<8>(1) - back);
      builder.add(std::abs(there - back) / back, coarse / back, input, MatrixXd::Constant(1, 1, back),
                  MatrixXd::Constant(1, 1, there));
    });
  }
  return {builder.finish()};
}

std::vector<Verdict> checkSymmetryAndTrace(const Candidate& candidate, std::size_t inputs, std::uint64_t seed,
                                           double tolerance) {
  if (!candidate.hessian) {
    return {};
  }
  const std::vector<Configuration> drawn = drawInputs(inputFamily("well-conditioned"), inputs, seed);
  VerdictBuilder symmetry(candidate.name, "symmetry", "well-conditioned", Quantity::kHessian, 2.0 * tolerance,
                          "the promise, for each of 2 entries");
  VerdictBuilder trace(candidate.name, "trace", "well-conditioned", Quantity::kHessian, 3.0 * tolerance,
                       "the promise, for each of 3 entries");
  for (const Configuration& input : drawn) {
    symmetry.attempt(input, [&] {
      const Matrix3d hessian = candidate.hessian_before_symmetrisation ? candidate.hessian_before_symmetrisation(input)
                                                                       : candidate.hessian(input);
      symmetry.add(maxNorm(hessian - hessian.transpose()) / maxNorm(hessian), 0.0, input, hessian.transpose(), hessian);
    });
    trace.attempt(input, [&] {
      using LongVector = Eigen::Matrix<long double, 3, 1>;
      const auto relative = [&](const Vector3d& v) -> LongVector {
        return v.cast<long double>() - input.receiver.position.cast<long double>();
      };
      const LongVector n = input.receiver.normal.cast<long double>();
      const std::vector<Vector3d>& vertices = input.polygon.vertices;
      long double sum = 0.0L;
      for (std::size_t i = 0; i < vertices.size(); ++i) {
        const LongVector r = relative(vertices[i]);
        const LongVector e = relative(vertices[(i + 1) % vertices.size()]) - r;
        // The edges of this family span at most a radian or so: 30 points leave less than the rounding of long double.
        const long double integral = boost::math::quadrature::gauss<long double, 30>::integrate(
            [&](long double t) {
              const long double square = (r + t * e).squaredNorm();
              return 1.0L / (square * square);
            },
            0.0L, 1.0L);
        sum -= n.dot(r.cross(e)) * integral;
      }
      const double expected = static_cast<double>(sum / std::numbers::pi_v<long double>);
      const Matrix3d hessian = candidate.hessian(input);
      trace.add(std::abs(hessian.trace() - expected) / maxNorm(hessian), 0.0, input, MatrixXd::Constant(1, 1, expected),
                MatrixXd::Constant(1, 1, hessian.trace()));
    });
  }
  return {symmetry.finish(), trace.finish()};
}

}  // namespace irradiff
