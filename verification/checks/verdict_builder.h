#pragma once

#include "verification/checks/usual_mistakes.h"
#include "verification/checks/verdict.h"
#include "verification/comparison/error_statistics.h"

#include <exception>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace irradiff {

/// Collects the errors of one check of one quantity and keeps the input that exceeds its allowance most.
class VerdictBuilder {
 public:
  VerdictBuilder(std::string candidate, std::string check, std::string family, Quantity quantity, double tolerance,
                 std::string rule);

  /// `error` relative as the check defines it, against an allowance of the tolerance plus the oracle's own relative
  /// `uncertainty`. An Input is anything that has a sceneLine() that turns it into a scene of one line, words for
  /// people by inWords(), and mistakes of its own by likelyCause() (usual_mistakes.h).
  template <class Input>
  void add(double error, double uncertainty, const Input& input, const Eigen::MatrixXd& expected,
           const Eigen::MatrixXd& actual) {
    if (excess(error, uncertainty) > 0.0) {
      addWrong(likelyCause(verdict_.quantity, input, expected, actual), expected.size() == 1);
    }
    if (isWorst(error, uncertainty)) {
      setWorst(error, uncertainty, sceneLine(input), inWords(input), expected, actual);
    }
  }

  /// Runs `evaluate`, which calls add() or throws; what it throws counts against the candidate.
  template <class Input, class Function>
  void attempt(const Input& input, const Function& evaluate) {
    try {
      evaluate();
    } catch (const std::exception& exception) {
      addException(exception, sceneLine(input), inWords(input));
    }
  }

  /// A check without inputs has not passed.
  Verdict finish() const;

 private:
  using Causes = std::map<std::string, std::size_t>;

  /// Counts the error; true if it exceeds its allowance by more than any before.
  bool isWorst(double error, double uncertainty);
  void addWrong(const std::string& cause, bool is_number);
  void setWorst(double error, double uncertainty, std::string line, std::string words, const Eigen::MatrixXd& expected,
                const Eigen::MatrixXd& actual);
  void addException(const std::exception& exception, std::string line, std::string words);
  Causes::const_iterator mostFrequentCause() const;  ///< the end if none says anything
  double excess(double error, double uncertainty) const;

  Verdict verdict_;
  ErrorStatistics statistics_;
  double worst_excess_ = -std::numeric_limits<double>::infinity();
  Causes wrong_inputs_by_cause_;
  std::size_t wrong_by_a_factor_ = 0;  ///< vectors and matrices
};

}  // namespace irradiff
