#include "verification/checks/verdict_builder.h"

#include "verification/checks/error_diagnosis.h"

#include <cmath>

namespace irradiff {

VerdictBuilder::VerdictBuilder(const Candidate& candidate, std::string check, std::string family, Quantity quantity,
                               double tolerance, std::string rule) {
  verdict_.candidate = candidate.name;
  verdict_.check = std::move(check);
  verdict_.family = std::move(family);
  verdict_.quantity = quantity;
  verdict_.tolerance = tolerance;
  verdict_.rule = std::move(rule);
  verdict_.passed = true;
  verdict_.worst.receiver = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
}

void VerdictBuilder::add(double error, double uncertainty, const Configuration& input, const Eigen::MatrixXd& expected,
                         const Eigen::MatrixXd& actual) {
  statistics_.add(error, statistics_.count());
  const double excess = std::isnan(error) ? std::numeric_limits<double>::infinity()
                                          : error - (verdict_.tolerance + uncertainty);
  const bool fails = !(excess <= 0.0);
  if (excess > worst_excess_) {
    worst_excess_ = excess;
    verdict_.worst = input;
    verdict_.expected = textOf(expected);
    verdict_.actual = textOf(actual);
    verdict_.likely_cause = fails ? diagnose(expected, actual) : "";
  }
  verdict_.passed = verdict_.passed && !fails;
}

void VerdictBuilder::addException(const std::exception& exception, const Configuration& input, const Eigen::MatrixXd& expected) {
  const double infinity = std::numeric_limits<double>::infinity();
  statistics_.add(infinity, statistics_.count());
  if (worst_excess_ < infinity) {
    worst_excess_ = infinity;
    verdict_.worst = input;
    verdict_.expected = expected.size() > 0 ? textOf(expected) : "a value";
    verdict_.actual = std::string("an exception: ") + exception.what();
    verdict_.likely_cause = "an input that the candidate does not accept";
  }
  verdict_.passed = false;
}

Verdict VerdictBuilder::finish() const {
  Verdict verdict = verdict_;
  verdict.inputs = statistics_.count();
  verdict.peak = statistics_.peak();
  verdict.rms = statistics_.rootMeanSquare();
  verdict.passed = verdict.passed && verdict.inputs > 0;
  return verdict;
}

}  // namespace irradiff
