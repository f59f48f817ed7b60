// Bounds of the certified path, and of the double path, on many inputs that are meant to break them, against enclosures
// of another formula.

#include "derivatives/boundary/irradiance.h"
#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/scene/invalid_scene.h"
#include "tests/certified/adversarial_inputs.h"
#include "verification/certified/ball_rounding.h"
#include "verification/certified/certified_polygon.h"
#include "verification/checks/input_families.h"
#include "verification/enclosure/contour_enclosure.h"
#include "verification/enclosure/polar_integral.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <future>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace irradiff {
namespace {

constexpr double kTolerance = kDefaultTolerance;
constexpr std::size_t kQuantities = 5;
constexpr std::array<const char*, kQuantities> kNames{"irradiance", "gradient", "hessian", "tangential hessian",
                                                      "rotational gradient"};

/// The numbers of each quantity in a row.
template <class Number>
using Numbers = std::array<std::vector<Number>, kQuantities>;

template <class Number, class Derivatives>
Numbers<Number> numbersOf(const Derivatives& d) {
  Numbers<Number> numbers;
  numbers[0].push_back(d.irradiance.value);
  const auto append = [](const auto& matrix, std::vector<Number>& row) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
      for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    }
  };
  append(d.gradient.value, numbers[1]);
  append(d.hessian.value, numbers[2]);
  append(d.tangential_hessian.value, numbers[3]);
  append(d.rotational_gradient.value, numbers[4]);
  return numbers;
}

std::array<double, kQuantities> boundsOf(const DerivativeBounds& b) {
  return {b.irradiance, b.gradient, b.hessian, b.tangential_hessian, b.rotational_gradient};
}

/// Irradiance and its derivatives from a form factor of either sign.
Numbers<Ball> irradianceOf(const FormFactorEnclosure& enclosure, const Receiver& receiver) {
  const WorkingPrecision precision(1024);
  const Ball factor = enclosure.value > Ball(0) ? Ball::pi() : -Ball::pi();
  const BallVector normal = exactly(receiver.normal);
  IrradianceDerivatives<Ball> d;
  d.irradiance.value = enclosure.value * factor;
  for (int i = 0; i < 3; ++i) {
    d.gradient.value(i) = enclosure.gradient(i) * factor;
    for (int j = 0; j < 3; ++j) d.hessian.value(i, j) = enclosure.hessian(i, j) * factor;
  }
  d.tangential_hessian = tangentialHessian<Ball>(d.hessian.value, normal);
  d.rotational_gradient.value = cross<Ball>(normal, enclosure.normal_gradient);
  for (int i = 0; i < 3; ++i) d.rotational_gradient.value(i) *= factor;
  return numbersOf<Ball>(d);
}

/// What one side of a bound says about a quantity.
struct Comparison {
  double excess = 0.0;     ///< the least that a number is off more than its bound; positive refutes the bound
  double sharpness = 0.0;  ///< the reference's own uncertainty over the bound
};

Comparison compare(const std::vector<double>& numbers, double bound, const std::vector<Ball>& reference) {
  const WorkingPrecision precision(1024);
  Comparison result{-bound, 0.0};
  double uncertainty = 0.0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Ball distance = abs(Ball(numbers[i]) - reference[i]);
    const Ball excess = distance - Ball(bound);
    if (excess > Ball(0)) result.excess = std::max(result.excess, excess.toDouble());
    uncertainty = std::max(uncertainty, magnitudeBound(reference[i].radius()));
  }
  result.sharpness = uncertainty > 0.0 ? uncertainty / bound : 0.0;
  return result;
}

struct Tally {
  std::size_t inputs = 0;
  std::size_t evaluated = 0;
  std::size_t blunt = 0;  ///< quantities for which the reference is not much better than the bound
  std::vector<std::string> failures;

  void fail(const std::string& what, const Configuration& input) {
    if (failures.size() < 5) failures.push_back(what + "\n" + sceneLine(input));
  }
};

/// `shrink` < 1 is the bad twin: bounds that claim too much.
void checkBounds(const char* path, const PolygonEvaluation& evaluation, double shrink, const Numbers<Ball>& reference,
                 const Configuration& input, Tally& tally) {
  const auto numbers = numbersOf<double>(evaluation.derivatives);
  const auto bounds = boundsOf(evaluation.bounds);
  for (std::size_t q = 0; q < kQuantities; ++q) {
    if ((q == 1 && !evaluation.no_gradient.empty()) || (q == 2 && !evaluation.no_hessian.empty())) continue;
    const Comparison comparison = compare(numbers[q], shrink * bounds[q], reference[q]);
    if (comparison.sharpness > 0.25) ++tally.blunt;
    if (comparison.excess > 0.0) {
      std::ostringstream text;
      text << path << ": " << kNames[q] << " is off by " << comparison.excess << " more than its bound "
           << shrink * bounds[q];
      tally.fail(text.str(), input);
    }
  }
}

/// Irradiance, gradient and Hessian, relative to the largest entry.
void checkTolerance(const CertifiedPolygon& certified, const Numbers<Ball>& reference, const Configuration& input,
                    Tally& tally) {
  const auto bounds = boundsOf(certified.evaluation.bounds);
  const WorkingPrecision precision(128);
  for (std::size_t q = 0; q < 3; ++q) {
    if (q == 2 && !certified.evaluation.no_hessian.empty()) continue;
    Ball norm;
    for (const Ball& number : reference[q]) norm = max(norm, abs(number));
    Ball bound(bounds[q]);
    if (certified.enclosure) {
      // What the doubles lose at the end of their range does not count.
      Ball radius;
      for (const Ball& number : numbersOf<Ball>(*certified.enclosure)[q]) radius = max(radius, number.radius());
      bound = min(bound, radius);
    }
    if (bound > norm * Ball(kTolerance)) {
      tally.fail(
          std::string(kNames[q]) + " misses the tolerance: bound " + bound.toDecimal(5) + " of " + norm.toDecimal(5),
          input);
    }
  }
}

using Enclose = FormFactorEnclosure (*)(const Polygon&, const Receiver&, int);

Tally checkRange(std::size_t first, std::size_t step, std::size_t count, Enclose enclose, int digits, double shrink) {
  Tally tally;
  for (std::size_t index = first; index < count; index += step) {
    ++tally.inputs;
    const auto input = adversarialInput(20261126, index);
    if (!input) continue;
    try {
      const CertifiedPolygon certified = certifyPolygon(input->polygon, 0, input->receiver, kTolerance);
      const PolygonEvaluation plain = evaluatePolygon(input->polygon, 0, input->receiver);
      if (certified.evaluation.rule != PolygonRule::kBoundary) continue;
      const Numbers<Ball> reference = irradianceOf(enclose(input->polygon, input->receiver, digits), input->receiver);
      ++tally.evaluated;
      checkBounds("certified", certified.evaluation, shrink, reference, *input, tally);
      checkBounds("double", plain, shrink, reference, *input, tally);
      checkTolerance(certified, reference, *input, tally);
    } catch (const InvalidScene&) {
      // The receiver is on the polygon, or results are beyond the range of double.
    } catch (const std::domain_error&) {
      // A vertex is on the horizon: the reference has no Hessian.
    } catch (const std::exception& error) {
      tally.fail(error.what(), *input);
    }
  }
  return tally;
}

Tally checkAllInputs(std::size_t count, Enclose enclose, int digits, double shrink) {
  const std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::future<Tally>> parts;
  for (std::size_t first = 0; first < threads; ++first) {
    parts.push_back(std::async(std::launch::async, checkRange, first, threads, count, enclose, digits, shrink));
  }
  Tally sum;
  for (auto& part : parts) {
    const Tally tally = part.get();
    sum.inputs += tally.inputs;
    sum.evaluated += tally.evaluated;
    sum.blunt += tally.blunt;
    sum.failures.insert(sum.failures.end(), tally.failures.begin(), tally.failures.end());
  }
  return sum;
}

std::string textOf(const Tally& tally) {
  std::string text;
  for (const std::string& failure : tally.failures) text += failure + "\n";
  return text;
}

TEST(AdversarialPolygons, BoundsHoldAndMeetTheTolerance) {
  const std::size_t count = lengthened(100'000);
  const Tally tally = checkAllInputs(count, encloseContour, 30, 1.0);
  EXPECT_TRUE(tally.failures.empty()) << textOf(tally);
  EXPECT_GT(tally.evaluated, count / 2);
  EXPECT_LT(tally.blunt, tally.evaluated / 10);
  RecordProperty("evaluated", std::to_string(tally.evaluated));
  std::cout << tally.evaluated << " of " << tally.inputs << " inputs compared, " << tally.blunt
            << " quantities with a blunt reference\n";
}

TEST(AdversarialPolygons, BoundsHoldAgainstTheDefiningIntegral) {
  const std::size_t count = lengthened(26);
  const Tally tally = checkAllInputs(count, enclosePolar, 20, 1.0);
  EXPECT_TRUE(tally.failures.empty()) << textOf(tally);
  EXPECT_GT(tally.evaluated, count / 4);
}

TEST(AdversarialPolygons, BoundsThatClaimTooMuchAreRefuted) {
  const Tally tally = checkAllInputs(200, encloseContour, 30, 1e-3);
  EXPECT_FALSE(tally.failures.empty());
}

}  // namespace
}  // namespace irradiff
