#include "verification/checks/verdict_builder.h"

#include "verification/checks/error_diagnosis.h"

#include <algorithm>
#include <cmath>

namespace irradiff {

VerdictBuilder::VerdictBuilder(std::string candidate, std::string check, std::string family, Quantity quantity,
                               double tolerance, std::string rule) {
  verdict_.candidate = std::move(candidate);
  verdict_.check = std::move(check);
  verdict_.family = std::move(family);
  verdict_.quantity = quantity;
  verdict_.tolerance = tolerance;
  verdict_.rule = std::move(rule);
  verdict_.passed = true;
}

double VerdictBuilder::excess(double error, double uncertainty) const {
  return std::isnan(error) ? std::numeric_limits<double>::infinity() : error - (verdict_.tolerance + uncertainty);
}

bool VerdictBuilder::isWorst(double error, double uncertainty) {
  statistics_.add(error, statistics_.count());
  verdict_.uncertainty = std::max(verdict_.uncertainty, uncertainty);
  verdict_.passed = verdict_.passed && excess(error, uncertainty) <= 0.0;
  return excess(error, uncertainty) > worst_excess_;
}

void VerdictBuilder::setWorst(double error, double uncertainty, std::string line, const Eigen::MatrixXd& expected,
                              const Eigen::MatrixXd& actual) {
  worst_excess_ = excess(error, uncertainty);
  verdict_.worst_input = std::move(line);
  verdict_.expected = textOf(expected);
  verdict_.actual = textOf(actual);
  verdict_.likely_cause = worst_excess_ > 0.0 ? diagnose(expected, actual) : "";
}

void VerdictBuilder::addException(const std::exception& exception, std::string line) {
  const double infinity = std::numeric_limits<double>::infinity();
  statistics_.add(infinity, statistics_.count());
  if (worst_excess_ < infinity) {
    worst_excess_ = infinity;
    verdict_.worst_input = std::move(line);
    verdict_.expected = "a value";
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
