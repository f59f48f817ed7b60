#pragma once

#include "verification/checks/verdict.h"
#include "verification/comparison/error_statistics.h"

#include <exception>
#include <limits>
#include <string>
#include <utility>

namespace irradiff {

/// Collects the errors of one check of one quantity and keeps the input that exceeds its allowance most.
class VerdictBuilder {
 public:
  VerdictBuilder(const Candidate& candidate, std::string check, std::string family, Quantity quantity, double tolerance, std::string rule);

  /// `error` relative as the check defines it, against an allowance of the tolerance plus the oracle's own relative `uncertainty`.
  void add(double error, double uncertainty, const Configuration& input, const Eigen::MatrixXd& expected, const Eigen::MatrixXd& actual);
  /// A candidate that throws has failed at this input.
  void addException(const std::exception& exception, const Configuration& input, const Eigen::MatrixXd& expected);

  /// Runs `evaluate`, which calls add() or throws; what it throws counts against the candidate.
  template <class Function>
  void attempt(const Configuration& input, const Function& evaluate) {
    try {
      evaluate();
    } catch (const std::exception& exception) {
      addException(exception, input, {});
    }
  }

  /// A check without inputs has not passed.
  Verdict finish() const;

 private:
  Verdict verdict_;
  ErrorStatistics statistics_;
  double worst_excess_ = -std::numeric_limits<double>::infinity();
};

}  // namespace irradiff
