#include "verification/checks/flatland_suite.h"

#include "derivatives/flatland/segment_evaluation.h"
#include "derivatives/flatland/segment_form.h"
#include "verification/checks/verdict_builder.h"
#include "verification/finite_difference/ridders.h"
#include "verification/multiprecision/multiprecision.h"
#include "verification/reference/reference_data.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace irradiff {
namespace {

using DynamicMultiprecision = Eigen::Matrix<Multiprecision, Eigen::Dynamic, Eigen::Dynamic>;
using Eigen::Vector2d;

using Vector2Multiprecision = Vector2<Multiprecision>;

/// Radians.
const Multiprecision kTurn("1e-40");

Vector2Multiprecision exact(const Vector2d& v) { return {Multiprecision(v(0)), Multiprecision(v(1))}; }

IrradianceDerivatives<Multiprecision, 2> evaluateExactly(const FlatlandConfiguration& c,
                                                         const Vector2Multiprecision& position,
                                                         const Vector2Multiprecision& normal) {
  const auto clipped =
      clipSegment<Multiprecision>(exact(c.segment.vertices[0]), exact(c.segment.vertices[1]), position, normal);
  return segmentBoundaryForm<Multiprecision>(clipped, normal).derivatives;
}

DynamicMultiprecision pick(const IrradianceDerivatives<Multiprecision, 2>& d, Quantity quantity) {
  switch (quantity) {
    case Quantity::kFormFactor:
    case Quantity::kIrradiance:
      return DynamicMultiprecision::Constant(1, 1, d.irradiance.value);
    case Quantity::kGradient:
      return d.gradient.value;
    case Quantity::kHessian:
      return d.hessian.value;
    case Quantity::kTangentialHessian:
      return d.tangential_hessian.value;
    case Quantity::kRotationalGradient:
      return d.rotational_gradient.value;
  }
  return {};
}

/// T.(H T) for the unit tangent T of the receiver's horizon.
Eigen::Matrix<Multiprecision, 1, 1> project(const Eigen::Matrix<Multiprecision, 2, 2>& hessian,
                                            const FlatlandConfiguration& c) {
  const Vector2Multiprecision tangent = quarterTurn(exact(c.receiver.normal));
  const Vector2Multiprecision slope = hessian * tangent;
  return Eigen::Matrix<Multiprecision, 1, 1>(Multiprecision(dot(tangent, slope) / dot(tangent, tangent)));
}

/// The derivatives of irradiance by differences of irradiance alone, at 200 digits.
IrradianceDerivatives<Multiprecision, 2> differences(const FlatlandConfiguration& c) {
  const Vector2Multiprecision x = exact(c.receiver.position);
  const Vector2Multiprecision n = exact(c.receiver.normal);
  const Multiprecision nearest = std::min<Multiprecision>(norm(difference(exact(c.segment.vertices[0]), x)),
                                                          norm(difference(exact(c.segment.vertices[1]), x)));
  const Multiprecision step = nearest * Multiprecision("1e-40");
  const auto irradiance = [&](int i, int si, int j, int sj) {
    Vector2Multiprecision y = x;
    y(i) += si * step;
    y(j) += sj * step;
    return evaluateExactly(c, y, n).irradiance.value;
  };
  IrradianceDerivatives<Multiprecision, 2> d = evaluateExactly(c, x, n);
  for (int i = 0; i < 2; ++i) {
    d.gradient.value(i) = (irradiance(i, 1, i, 0) - irradiance(i, -1, i, 0)) / (2 * step);
    for (int j = 0; j < 2; ++j) {
      d.hessian.value(i, j) =
          (irradiance(i, 1, j, 1) - irradiance(i, 1, j, -1) - irradiance(i, -1, j, 1) + irradiance(i, -1, j, -1)) /
          (4 * step * step);
    }
  }
  d.tangential_hessian.value = project(d.hessian.value, c);
  // A counterclockwise turn moves the normal along its quarter turn. So small a turn that no end crosses the horizon.
  const auto turned = [&](int sign) {
    const Vector2Multiprecision motion = quarterTurn(n);
    return evaluateExactly(c, x, {n(0) + sign * kTurn * motion(0), n(1) + sign * kTurn * motion(1)}).irradiance.value;
  };
  d.rotational_gradient.value(0) = (turned(1) - turned(-1)) / (2 * kTurn);
  return d;
}

Multiprecision maxNorm(const DynamicMultiprecision& m) {
  Multiprecision largest = 0;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    largest = std::max<Multiprecision>(largest, abs(m(i)));
  }
  return largest;
}

/// The size of what a quantity that is a single number is a component of; 0 for the others. Such a number changes its
/// sign. The rotational gradient makes up a vector with irradiance, and the tangential Hessian is an entry of the
/// Hessian.
Multiprecision wholeOf(Quantity quantity, const Multiprecision& irradiance, const DynamicMultiprecision& hessian) {
  switch (quantity) {
    case Quantity::kRotationalGradient:
      return abs(irradiance);
    case Quantity::kTangentialHessian:
      return maxNorm(hessian);
    default:
      return 0;
  }
}

Eigen::MatrixXd toDouble(const DynamicMultiprecision& m) {
  return m.unaryExpr([](const Multiprecision& v) { return v.convert_to<double>(); }).cast<double>();
}

/// The candidate's value. What it throws counts against the bounds as well: they may be all that is judged.
Eigen::MatrixXd evaluateFor(VerdictBuilder* bounds, const FlatlandCandidate& candidate, Quantity quantity,
                            const FlatlandConfiguration& input) {
  try {
    return candidate.evaluate(quantity, input);
  } catch (const std::exception&) {
    if (bounds != nullptr) {
      bounds->attempt(input, [] { throw; });
    }
    throw;
  }
}

/// Compares one quantity at one input with its expected value, relative to the larger of that and `whole`, and the
/// claimed bound with the error.
void compare(const FlatlandCandidate& candidate, Quantity quantity, const FlatlandConfiguration& input,
             const DynamicMultiprecision& expected, const Multiprecision& whole, double uncertainty,
             VerdictBuilder& values, VerdictBuilder* bounds) {
  values.attempt(input, [&] {
    const Eigen::MatrixXd actual = evaluateFor(bounds, candidate, quantity, input);
    const Multiprecision norm = std::max<Multiprecision>(maxNorm(expected), whole);
    const Multiprecision error = actual.allFinite() ? maxNorm(actual.cast<Multiprecision>() - expected)
                                                    : std::numeric_limits<Multiprecision>::quiet_NaN();
    if (norm > 0) {
      values.add(Multiprecision(error / norm).convert_to<double>(),
                 Multiprecision(uncertainty / norm).convert_to<double>(), input, toDouble(expected), actual);
    }
    if (bounds != nullptr && candidate.bounds) {
      const DerivativeBounds claimed = candidate.bounds(input);
      const double bound = boundOf(claimed, quantity);
      const double ratio = error == 0 ? 0.0 : Multiprecision(error / bound).convert_to<double>();
      bounds->add(ratio, uncertainty == 0.0 ? 0.0 : uncertainty / bound, input, toDouble(expected), actual);
    }
  });
}

std::vector<Verdict> checkFamily(const FlatlandCandidate& candidate, const FlatlandFamily& family,
                                 const FlatlandSuiteOptions& options) {
  std::vector<FlatlandConfiguration> inputs;
  for (std::size_t i = 0; i < options.inputs; ++i) {
    KeyedRandom random(options.seed, family.name, i);
    inputs.push_back(family.draw(random));
  }
  std::vector<Verdict> verdicts;
  for (const Quantity quantity : kQuantities) {
    if (!candidate.has(quantity)) {
      continue;
    }
    VerdictBuilder rounding(candidate.name, "multiprecision", family.name, quantity, options.tolerance, "the promise");
    VerdictBuilder algebra(candidate.name, "differences at 200 digits", family.name, quantity, options.tolerance,
                           "the promise");
    VerdictBuilder bounds(candidate.name, "claimed bound", family.name, quantity, 1.0,
                          "the error is at most the claimed bound");
    for (const FlatlandConfiguration& input : inputs) {
      const IrradianceDerivatives<Multiprecision, 2> expected =
          evaluateExactly(input, exact(input.receiver.position), exact(input.receiver.normal));
      const Multiprecision whole = wholeOf(quantity, expected.irradiance.value, expected.hessian.value);
      compare(candidate, quantity, input, pick(expected, quantity), whole, 0.0, rounding, &bounds);
      if (family.promises_digits) {
        compare(candidate, quantity, input, pick(differences(input), quantity), whole, 0.0, algebra, nullptr);
      }
    }
    if (family.promises_digits) {
      verdicts.push_back(rounding.finish());
      verdicts.push_back(algebra.finish());
    }
    if (candidate.bounds) {
      verdicts.push_back(bounds.finish());
    }
  }
  return verdicts;
}

/// Irradiance against int max(0, n.p) |N.p| / |p|^3 dl by adaptive quadrature in long double on generic segments.
Verdict checkDefiningIntegral(const FlatlandCandidate& candidate, const FlatlandSuiteOptions& options) {
  VerdictBuilder builder(candidate.name, "defining integral", flatlandFamilies()[0].name, Quantity::kFormFactor,
                         options.tolerance, "the promise, above the quadrature's own error");
  for (std::size_t i = 0; i < options.inputs; ++i) {
    KeyedRandom random(options.seed, flatlandFamilies()[0].name, i);
    const FlatlandConfiguration input = flatlandFamilies()[0].draw(random);
    using LongVector = Eigen::Matrix<long double, 2, 1>;
    const LongVector n = input.receiver.normal.cast<long double>();
    const LongVector r0 = input.segment.vertices[0].cast<long double>() - input.receiver.position.cast<long double>();
    const LongVector e = input.segment.vertices[1].cast<long double>() - input.segment.vertices[0].cast<long double>();
    const long double h0 = n.dot(r0);
    const long double h1 = n.dot(LongVector(r0 + e));
    const long double cut = h0 * h1 < 0.0L ? h0 / (h0 - h1) : (h0 < 0.0L ? 0.0L : 1.0L);
    const long double from = h0 < 0.0L ? cut : 0.0L;
    const long double to = h1 < 0.0L ? cut : 1.0L;
    long double error = 0.0L;
    const long double expected = boost::math::quadrature::gauss_kronrod<long double, 61>::integrate(
        [&](long double t) {
          const LongVector p = r0 + t * e;
          const long double square = p.squaredNorm();
          return n.dot(p) * std::abs(p(0) * e(1) - p(1) * e(0)) / (square * std::sqrt(square));
        },
        from, to, 12, 1e-17L, &error);
    builder.attempt(input, [&] {
      const double actual = candidate.irradiance(input);
      builder.add(static_cast<double>(std::abs(actual - expected) / expected), static_cast<double>(error / expected),
                  input, Eigen::MatrixXd::Constant(1, 1, static_cast<double>(expected)),
                  Eigen::MatrixXd::Constant(1, 1, actual));
    });
  }
  return builder.finish();
}

/// A closed polygon around the receiver: irradiance 2 for radiance 1, derivatives 0.
std::vector<Verdict> checkFlatlandClosure(const FlatlandCandidate& candidate, const FlatlandSuiteOptions& options) {
  std::vector<Verdict> verdicts;
  for (const Quantity quantity : kQuantities) {
    if (!candidate.has(quantity)) {
      continue;
    }
    VerdictBuilder builder(candidate.name, "closure", "flatland, closed polygons", quantity, 7.0 * options.tolerance,
                           "the promise, for each of 7 segments, relative to the largest");
    for (std::size_t i = 0; i < options.inputs; ++i) {
      KeyedRandom random(options.seed, "flatland closure", i);
      const FlatlandReceiver receiver{0.05 * drawPoint(random), directionAt(random.between(0.0, 6.28))};
      std::vector<Vector2d> corners;
      corners.reserve(7);
      for (int k = 0; k < 7; ++k) {
        corners.push_back(random.between(0.5, 1.5) *
                          directionAt(2.0 * std::numbers::pi * (k + random.between(0.0, 0.6)) / 7.0));
      }
      const FlatlandConfiguration first{{"side", {corners[0], corners[1]}, 1.0}, receiver};
      builder.attempt(first, [&] {
        Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(1, 1);
        double largest = 0.0;
        for (std::size_t k = 0; k < corners.size(); ++k) {
          const FlatlandConfiguration side{{"side", {corners[k], corners[(k + 1) % corners.size()]}, 1.0}, receiver};
          const Eigen::MatrixXd part = candidate.evaluate(quantity, side);
          sum = k == 0 ? part : Eigen::MatrixXd(sum + part);
          // The rotational gradient of a side straight ahead vanishes, but not what it is the tangential part of.
          const double of_vector = quantity == Quantity::kRotationalGradient && candidate.irradiance
                                       ? candidate.evaluate(Quantity::kFormFactor, side)(0)
                                       : 0.0;
          largest = std::max({largest, part.cwiseAbs().maxCoeff(), of_vector});
        }
        Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(sum.rows(), sum.cols());
        if (quantity == Quantity::kFormFactor) {
          expected(0, 0) = 2.0 * receiver.normal.norm();
        }
        builder.add((sum - expected).cwiseAbs().maxCoeff() / largest, 0.0, first, expected, sum);
      });
    }
    verdicts.push_back(builder.finish());
  }
  return verdicts;
}

DynamicMultiprecision expectedOf(const FlatlandReferenceCase& c, Quantity quantity) {
  const auto parse = [](const auto& numbers) {
    DynamicMultiprecision result(numbers.rows(), numbers.cols());
    for (Eigen::Index i = 0; i < numbers.rows(); ++i) {
      for (Eigen::Index j = 0; j < numbers.cols(); ++j) {
        result(i, j) = Multiprecision(numbers(i, j).decimal);
      }
    }
    return result;
  };
  switch (quantity) {
    case Quantity::kFormFactor:
    case Quantity::kIrradiance:
      return DynamicMultiprecision::Constant(1, 1, Multiprecision(c.value.decimal));
    case Quantity::kGradient:
      return parse(c.gradient);
    case Quantity::kHessian:
      return parse(c.hessian);
    case Quantity::kTangentialHessian:
      return project(parse(c.hessian), {c.segment, c.receiver});
    case Quantity::kRotationalGradient:
      return parse(c.rotational_gradient);
  }
  return {};
}

double errorOf(const FlatlandReferenceCase& c, Quantity quantity) {
  const auto parse = [](const std::string& text) { return std::strtod(text.c_str(), nullptr); };
  switch (quantity) {
    case Quantity::kFormFactor:
    case Quantity::kIrradiance:
      return parse(c.error.value);
    case Quantity::kGradient:
      return parse(c.error.gradient);
    case Quantity::kHessian:
      return parse(c.error.hessian);
    case Quantity::kTangentialHessian:
      // Components of a unit vector add up to at most the root of 2.
      return 2.0 * parse(c.error.hessian);
    case Quantity::kRotationalGradient:
      return parse(c.error.rotational_gradient);
  }
  return 0.0;
}

std::vector<Verdict> checkReferences(const FlatlandCandidate& candidate, const FlatlandSuiteOptions& options) {
  std::vector<Verdict> verdicts;
  const std::vector<FlatlandReferenceCase> cases = readFlatlandReferenceData(options.reference_folder);
  for (const Quantity quantity : kQuantities) {
    if (!candidate.has(quantity)) {
      continue;
    }
    VerdictBuilder values(candidate.name, "reference data", "flatland", quantity, options.tolerance,
                          "the promise on the reference cases");
    VerdictBuilder bounds(candidate.name, "claimed bound", "flatland reference data", quantity, 1.0,
                          "the error is at most the claimed bound");
    for (const FlatlandReferenceCase& c : cases) {
      const Multiprecision whole =
          wholeOf(quantity, Multiprecision(c.value.decimal), expectedOf(c, Quantity::kHessian));
      compare(candidate, quantity, {c.segment, c.receiver}, expectedOf(c, quantity), whole, errorOf(c, quantity),
              values, &bounds);
    }
    verdicts.push_back(values.finish());
    if (candidate.bounds) {
      verdicts.push_back(bounds.finish());
    }
  }
  return verdicts;
}

void append(std::vector<Verdict>& all, std::vector<Verdict> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

}  // namespace

Eigen::MatrixXd FlatlandCandidate::evaluate(Quantity quantity, const FlatlandConfiguration& configuration) const {
  switch (quantity) {
    case Quantity::kFormFactor:
    case Quantity::kIrradiance:
      return Eigen::MatrixXd::Constant(1, 1, irradiance(configuration));
    case Quantity::kGradient:
      return gradient(configuration);
    case Quantity::kHessian:
      return hessian(configuration);
    case Quantity::kTangentialHessian:
      return Eigen::MatrixXd::Constant(1, 1, tangential_hessian(configuration));
    case Quantity::kRotationalGradient:
      return Eigen::MatrixXd::Constant(1, 1, rotational_gradient(configuration));
  }
  return {};
}

bool FlatlandCandidate::has(Quantity quantity) const {
  switch (quantity) {
    case Quantity::kFormFactor:
    case Quantity::kIrradiance:
      return static_cast<bool>(irradiance);
    case Quantity::kGradient:
      return static_cast<bool>(gradient);
    case Quantity::kHessian:
      return static_cast<bool>(hessian);
    case Quantity::kTangentialHessian:
      return static_cast<bool>(tangential_hessian);
    case Quantity::kRotationalGradient:
      return static_cast<bool>(rotational_gradient);
  }
  return false;
}

FlatlandCandidate flatlandCandidate() {
  const auto evaluate = [](const FlatlandConfiguration& c) { return evaluateSegment(c.segment, 0, c.receiver); };
  return {"flatland",
          [evaluate](const FlatlandConfiguration& c) { return evaluate(c).derivatives.irradiance.value; },
          [evaluate](const FlatlandConfiguration& c) { return evaluate(c).derivatives.gradient.value; },
          [evaluate](const FlatlandConfiguration& c) { return evaluate(c).derivatives.hessian.value; },
          [evaluate](const FlatlandConfiguration& c) { return evaluate(c).derivatives.tangential_hessian.value(0); },
          [evaluate](const FlatlandConfiguration& c) { return evaluate(c).derivatives.rotational_gradient.value(0); },
          [evaluate](const FlatlandConfiguration& c) { return evaluate(c).bounds; }};
}

std::vector<Verdict> checkFlatland(const FlatlandCandidate& candidate, const FlatlandSuiteOptions& options) {
  std::vector<Verdict> verdicts;
  for (const FlatlandFamily& family : flatlandFamilies()) {
    append(verdicts, checkFamily(candidate, family, options));
  }
  if (candidate.irradiance) {
    verdicts.push_back(checkDefiningIntegral(candidate, options));
  }
  append(verdicts, checkFlatlandClosure(candidate, options));
  if (!options.reference_folder.empty()) {
    append(verdicts, checkReferences(candidate, options));
  }
  return verdicts;
}

}  // namespace irradiff
