#include "verification/report/error_sweeps.h"

#include "verification/checks/oracle.h"
#include "verification/checks/random.h"
#include "verification/checks/verdict_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>

namespace irradiff {
namespace {

constexpr std::array<Quantity, 2> kSweptQuantities = {Quantity::kGradient, Quantity::kHessian};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using DynamicMultiprecision = Eigen::Matrix<Multiprecision, Eigen::Dynamic, Eigen::Dynamic>;

struct Sample {
  Configuration input;
  OracleValue expected;

  DynamicMultiprecision expectedOf(Quantity quantity) const {
    return quantity == Quantity::kGradient ? DynamicMultiprecision(expected.gradient)
                                           : DynamicMultiprecision(expected.hessian);
  }
};

Multiprecision maxNorm(const DynamicMultiprecision& m) {
  Multiprecision largest = 0;
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    largest = std::max<Multiprecision>(largest, abs(m(i)));
  }
  return largest;
}

double ratio(const Multiprecision& a, const Multiprecision& b) { return Multiprecision(a / b).convert_to<double>(); }

Eigen::MatrixXd toDouble(const DynamicMultiprecision& m) {
  Eigen::MatrixXd result(m.rows(), m.cols());
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    result(i) = m(i).convert_to<double>();
  }
  return result;
}

std::vector<Sample> samplesOf(const SweepInputs& inputs, double size, std::size_t bin, std::size_t count,
                              std::uint64_t seed) {
  const Oracle oracle = multiprecisionOracle();
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < count; ++i) {
    KeyedRandom random(seed, inputs.file, bin * count + i);
    const Configuration input = inputs.draw(random, size);
    samples.push_back({input, oracle.evaluate(input).value()});
  }
  return samples;
}

/// Relative error of a formula; infinite for NaN and for an exception, which a comparison is free to throw.
double relativeError(const Candidate& candidate, Quantity quantity, const Sample& sample) {
  try {
    const Eigen::MatrixXd actual = candidate.evaluate(quantity, sample.input);
    if (!actual.allFinite()) {
      return kInfinity;
    }
    const DynamicMultiprecision expected = sample.expectedOf(quantity);
    return ratio(maxNorm(actual.cast<Multiprecision>() - expected), maxNorm(expected));
  } catch (const std::exception&) {
    return kInfinity;
  }
}

double relativeBound(const Candidate& candidate, Quantity quantity, const Sample& sample) {
  try {
    return ratio(boundOf(candidate.bounds(sample.input), quantity), maxNorm(sample.expectedOf(quantity)));
  } catch (const std::exception&) {
    return kInfinity;
  }
}

SweepPoint pointOf(const Candidate& candidate, Quantity quantity, double size, const std::vector<Sample>& samples) {
  SweepPoint point;
  point.size = size;
  std::vector<double> errors;
  for (const Sample& sample : samples) {
    errors.push_back(relativeError(candidate, quantity, sample));
    if (candidate.bounds) {
      point.bound = std::max(point.bound, relativeBound(candidate, quantity, sample));
    }
  }
  std::sort(errors.begin(), errors.end());
  point.median = errors[errors.size() / 2];
  point.peak = errors.back();
  return point;
}

/// Judges one quantity of the promised formula over all sizes of a sweep.
class SweepJudge {
 public:
  SweepJudge(const SweepInputs& inputs, const Candidate& candidate, Quantity quantity)
      : candidate_(candidate),
        quantity_(quantity),
        promise_(quantity == Quantity::kGradient ? inputs.gradient_promise : inputs.hessian_promise),
        errors_(candidate.name, "multiprecision", "sweep: " + inputs.name, quantity, promise_,
                "the promise on this family"),
        bounds_(candidate.name, "claimed bound", "sweep: " + inputs.name, quantity, 1.0,
                "the error is at most the claimed bound") {}

  void add(const Sample& sample) {
    errors_.attempt(sample.input, [&] {
      const Eigen::MatrixXd actual = candidate_.evaluate(quantity_, sample.input);
      const DynamicMultiprecision expected = sample.expectedOf(quantity_);
      const Multiprecision error = actual.allFinite() ? maxNorm(actual.cast<Multiprecision>() - expected)
                                                      : std::numeric_limits<Multiprecision>::quiet_NaN();
      errors_.add(ratio(error, maxNorm(expected)), 0.0, sample.input, toDouble(expected), actual);
      if (candidate_.bounds) {
        const Multiprecision bound = boundOf(candidate_.bounds(sample.input), quantity_);
        bounds_.add(error == 0 ? 0.0 : ratio(error, bound), 0.0, sample.input, toDouble(expected), actual);
      }
    });
  }

  void appendTo(ErrorSweep& sweep) const {
    (promise_ > 0.0 ? sweep.verdicts : sweep.unjudged).push_back(errors_.finish());
    if (candidate_.bounds) {
      sweep.verdicts.push_back(bounds_.finish());
    }
  }

 private:
  const Candidate& candidate_;
  Quantity quantity_;
  double promise_;
  VerdictBuilder errors_;
  VerdictBuilder bounds_;
};

}  // namespace

ErrorSweep sweepErrors(const SweepInputs& inputs, const Candidate& promised, const std::vector<Candidate>& comparisons,
                       std::size_t samples_for_each_size, std::uint64_t seed) {
  ErrorSweep sweep{&inputs, samples_for_each_size, {}, {}, {}};
  std::vector<const Candidate*> candidates = {&promised};
  for (const Candidate& comparison : comparisons) {
    candidates.push_back(&comparison);
  }
  std::vector<SweepJudge> judges;
  for (const Quantity quantity : kSweptQuantities) {
    judges.emplace_back(inputs, promised, quantity);
    for (const Candidate* candidate : candidates) {
      sweep.curves.push_back({candidate->name, quantity, {}});
    }
  }
  const int bins = 2 * (inputs.last_decade - inputs.first_decade) + 1;
  for (int bin = 0; bin < bins; ++bin) {
    const double size = std::pow(10.0, inputs.first_decade + 0.5 * bin);
    const std::vector<Sample> samples =
        samplesOf(inputs, size, static_cast<std::size_t>(bin), samples_for_each_size, seed);
    std::size_t curve = 0;
    for (std::size_t q = 0; q < kSweptQuantities.size(); ++q) {
      for (const Candidate* candidate : candidates) {
        sweep.curves[curve++].points.push_back(pointOf(*candidate, kSweptQuantities[q], size, samples));
      }
      for (const Sample& sample : samples) {
        judges[q].add(sample);
      }
    }
  }
  for (const SweepJudge& judge : judges) {
    judge.appendTo(sweep);
  }
  return sweep;
}

}  // namespace irradiff
