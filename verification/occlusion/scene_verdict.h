#pragma once

#include "verification/comparison/error_statistics.h"
#include "verification/occlusion/scene_candidate.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace irradiff {

/// The outcome of one check of one quantity over one family of scenes; the same parts as a Verdict on polygons
/// (verification/checks/verdict.h).
struct SceneVerdict {
  std::string candidate;
  std::string check;
  std::string family;
  SceneQuantity quantity = SceneQuantity::kIrradiance;
  bool passed = false;
  std::size_t inputs = 0;
  double peak = 0.0;  ///< largest error, as the rule says
  double rms = 0.0;
  double tolerance = 0.0;
  std::string rule;         ///< what the errors are relative to, and where the tolerance comes from
  std::string worst_input;  ///< a scene file of one line: what `irradiff evaluate` reads
  std::string expected;     ///< at the worst input
  std::string actual;
  std::string likely_cause;  ///< what usually makes this check fail; empty if it passed
};

/// Several lines like a compiler's message.
std::string describe(const SceneVerdict& verdict);

/// Those that failed.
std::vector<SceneVerdict> failures(const std::vector<SceneVerdict>& verdicts);

/// Collects the errors of one check of one quantity and keeps the worst input.
class SceneVerdictBuilder {
 public:
  SceneVerdictBuilder(std::string candidate, std::string check, std::string family, SceneQuantity quantity,
                      double tolerance, std::string rule);

  void add(double error, const OccludedScene& scene, const Eigen::MatrixXd& expected, const Eigen::MatrixXd& actual);

  /// Runs `evaluate`, which calls add() or throws; what it throws counts against the candidate.
  void attempt(const OccludedScene& scene, const std::function<void()>& evaluate);

  /// A check without inputs has not passed.
  SceneVerdict finish() const;

 private:
  SceneVerdict verdict_;
  ErrorStatistics statistics_;
};

}  // namespace irradiff
