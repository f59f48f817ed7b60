#include "verification/checks/verdict_builder.h"

#include "verification/checks/error_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace irradiff {
namespace {

/// The entry with the largest difference: "x", or "x, y". Empty for a number and where all differences are alike.
std::string worstEntry(const Eigen::MatrixXd& expected, const Eigen::MatrixXd& actual) {
  constexpr std::string_view kAxes = "xyz";
  constexpr std::string_view kTangents = "tb";
  if (expected.size() == 1 || !actual.allFinite()) {
    return "";
  }
  const std::string_view names = expected.rows() == 2 ? kTangents : kAxes;
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  (actual - expected).cwiseAbs().maxCoeff(&row, &column);
  std::string text(1, names[static_cast<std::size_t>(row)]);
  if (expected.cols() > 1) {
    text += std::string(", ") + names[static_cast<std::size_t>(column)];
  }
  return text;
}

/// What usually makes a check fail whose failing says by itself what is wrong; empty for the others.
std::string usualCauseOf(const std::string& check) {
  static const std::map<std::string, const char*> kCauses = {
      {"scaling", "a length in metres in the formula: an absolute threshold, an epsilon, a step"},
      {"unit of length", "a length in metres in the code: an absolute threshold, an epsilon, a step"},
      {"rotation", "a preferred axis: one coordinate used alone, or a frame that jumps"},
      {"quarter turn", "a preferred axis: one coordinate used alone, or a frame that jumps"},
      {"mirror", "a cross product too many, or in the wrong order"},
      {"reversal", "an absolute value or a square: the orientation of the vertices is lost"},
      {"closure", "the part below the horizon is not cut away, or the horizon's own edge is forgotten"},
      {"constant radiance", "edges between equal radiances do not cancel, or the boundary is open at the horizon"},
      {"additivity", "the edge that two polygons share does not cancel"},
      {"split polygon", "the edge that two polygons share does not cancel"},
      {"unseen polygon",
       "what cannot be seen changes the result: depth is compared wrongly, or the sum's order changes"},
      {"reciprocity", "the cosine at one of both ends, or a power of the distance, is wrong"},
      {"differences of its own form factor", "the gradient belongs to another function than the form factor"},
      {"differences of its own gradient", "the Hessian belongs to another function than the gradient"},
      {"differences over the normal", "the rotational gradient belongs to another function than the form factor"},
  };
  const auto found = kCauses.find(check);
  return found != kCauses.end() ? found->second : "";
}

}  // namespace

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

void VerdictBuilder::addWrong(const std::string& cause, bool is_number) {
  ++verdict_.wrong_inputs;
  if (!cause.empty()) {
    ++wrong_inputs_by_cause_[cause];
  }
  // Any wrong number is the right one times some factor.
  if (!is_number && cause.starts_with(kFactorText)) {
    ++wrong_by_a_factor_;
  }
}

void VerdictBuilder::setWorst(double error, double uncertainty, std::string line, std::string words,
                              const Eigen::MatrixXd& expected, const Eigen::MatrixXd& actual) {
  worst_excess_ = excess(error, uncertainty);
  verdict_.worst_input = std::move(line);
  verdict_.worst_input_in_words = std::move(words);
  verdict_.expected = textOf(expected);
  verdict_.actual = textOf(actual);
  verdict_.worst_entry = worstEntry(expected, actual);
}

void VerdictBuilder::addException(const std::exception& exception, std::string line, std::string words) {
  const double infinity = std::numeric_limits<double>::infinity();
  statistics_.add(infinity, statistics_.count());
  if (worst_excess_ < infinity) {
    worst_excess_ = infinity;
    verdict_.worst_input = std::move(line);
    verdict_.worst_input_in_words = std::move(words);
    verdict_.expected = "a value";
    verdict_.actual = std::string("an exception: ") + exception.what();
    verdict_.worst_entry.clear();
  }
  addWrong("an input that the candidate does not accept", false);
  verdict_.passed = false;
}

VerdictBuilder::Causes::const_iterator VerdictBuilder::mostFrequentCause() const {
  auto most = wrong_inputs_by_cause_.end();
  for (auto cause = wrong_inputs_by_cause_.begin(); cause != wrong_inputs_by_cause_.end(); ++cause) {
    // What one of many wrong inputs looks like is a coincidence.
    const bool counts = cause->second > 1 || verdict_.wrong_inputs == 1;
    // A mistake that is recognised twice is the reason for what is not finite elsewhere.
    const bool is_better = most == wrong_inputs_by_cause_.end() || most->first == kNotFiniteText ||
                           (cause->first != kNotFiniteText && cause->second > most->second);
    if (counts && is_better) {
      most = cause;
    }
  }
  return most;
}

Verdict VerdictBuilder::finish() const {
  Verdict verdict = verdict_;
  verdict.inputs = statistics_.count();
  verdict.peak = statistics_.peak();
  verdict.rms = statistics_.rootMeanSquare();
  verdict.passed = verdict.passed && verdict.inputs > 0;
  if (const auto most = mostFrequentCause(); most != wrong_inputs_by_cause_.end()) {
    verdict.likely_cause = most->first;
    verdict.inputs_of_cause = most->second;
  }
  const bool is_explained = verdict.inputs_of_cause == verdict.wrong_inputs;
  if (!is_explained && wrong_by_a_factor_ == verdict.wrong_inputs) {
    verdict.likely_cause = kFactorText;
    verdict.likely_cause += "that depends on the input";
    verdict.inputs_of_cause = wrong_by_a_factor_;
  }
  const bool is_finite = !wrong_inputs_by_cause_.contains(std::string(kNotFiniteText));
  if (const std::string usual = usualCauseOf(verdict.check); !is_explained && is_finite && !usual.empty()) {
    const bool is_factor = verdict.likely_cause.starts_with(kFactorText);
    verdict.likely_cause = is_factor ? verdict.likely_cause.append(": ").append(usual) : usual;
    verdict.inputs_of_cause = is_factor ? verdict.inputs_of_cause : 0;
  }
  return verdict;
}

}  // namespace irradiff
