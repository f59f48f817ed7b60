#include "verification/occlusion/scene_verdict.h"

#include "verification/checks/error_diagnosis.h"

#include <cmath>
#include <exception>
#include <sstream>
#include <utility>

namespace irradiff {

std::string describe(const SceneVerdict& verdict) {
  std::ostringstream text;
  text.precision(3);
  text << verdict.candidate << ": " << nameOf(verdict.quantity) << (verdict.passed ? ": ok" : ": WRONG") << " ["
       << verdict.check << ", " << verdict.family << ", " << verdict.inputs << " inputs]\n"
       << "  peak " << verdict.peak << ", rms " << verdict.rms << ", allowed " << verdict.tolerance << " ("
       << verdict.rule << ")";
  if (!verdict.passed) {
    text << "\n  expected " << verdict.expected << "\n  got      " << verdict.actual;
    if (!verdict.likely_cause.empty()) text << "\n  likely   " << verdict.likely_cause;
    text << "\n  input    " << verdict.worst_input;
  }
  return text.str();
}

std::vector<SceneVerdict> failures(const std::vector<SceneVerdict>& verdicts) {
  std::vector<SceneVerdict> failed;
  for (const SceneVerdict& verdict : verdicts) {
    if (!verdict.passed) failed.push_back(verdict);
  }
  return failed;
}

SceneVerdictBuilder::SceneVerdictBuilder(std::string candidate, std::string check, std::string family,
                                         SceneQuantity quantity, double tolerance, std::string rule) {
  verdict_.candidate = std::move(candidate);
  verdict_.check = std::move(check);
  verdict_.family = std::move(family);
  verdict_.quantity = quantity;
  verdict_.tolerance = tolerance;
  verdict_.rule = std::move(rule);
}

void SceneVerdictBuilder::add(double error, const OccludedScene& scene, const Eigen::MatrixXd& expected,
                              const Eigen::MatrixXd& actual) {
  const std::size_t index = statistics_.count();
  statistics_.add(error, index);
  if (statistics_.worstInput() != index) return;
  verdict_.worst_input = sceneLine(scene);
  verdict_.expected = textOf(expected);
  verdict_.actual = textOf(actual);
  verdict_.likely_cause = error <= verdict_.tolerance ? "" : diagnose(expected, actual);
}

void SceneVerdictBuilder::attempt(const OccludedScene& scene, const std::function<void()>& evaluate) {
  try {
    evaluate();
  } catch (const std::exception& exception) {
    const std::size_t index = statistics_.count();
    statistics_.add(std::numeric_limits<double>::infinity(), index);
    if (statistics_.worstInput() != index) return;
    verdict_.worst_input = sceneLine(scene);
    verdict_.expected = "a value";
    verdict_.actual = std::string("an exception: ") + exception.what();
    verdict_.likely_cause = "an input that the candidate does not accept";
  }
}

SceneVerdict SceneVerdictBuilder::finish() const {
  SceneVerdict verdict = verdict_;
  verdict.inputs = statistics_.count();
  verdict.peak = statistics_.peak();
  verdict.rms = statistics_.rootMeanSquare();
  // A NaN compares false.
  verdict.passed = verdict.inputs > 0 && verdict.peak <= verdict.tolerance;
  return verdict;
}

}  // namespace irradiff
