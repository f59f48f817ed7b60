#include "verification/checks/verdict.h"

#include <sstream>

namespace irradiff {

std::string describe(const Verdict& verdict) {
  std::ostringstream text;
  text.precision(3);
  text << verdict.candidate << ": " << nameOf(verdict.quantity) << (verdict.passed ? ": ok" : ": WRONG") << " ["
       << verdict.check << ", " << verdict.family << ", " << verdict.inputs << " inputs]\n"
       << "  peak " << verdict.peak << ", rms " << verdict.rms << ", allowed " << verdict.tolerance
       << " above the oracle's own " << verdict.uncertainty << " (" << verdict.rule << ")";
  if (!verdict.passed) {
    text << "\n  expected " << verdict.expected << "\n  got      " << verdict.actual;
    if (!verdict.likely_cause.empty()) {
      text << "\n  likely   " << verdict.likely_cause;
    }
    text << "\n  input    " << verdict.worst_input;
  }
  return text.str();
}

std::vector<Verdict> failures(const std::vector<Verdict>& verdicts) {
  std::vector<Verdict> failed;
  for (const Verdict& verdict : verdicts) {
    if (!verdict.passed) {
      failed.push_back(verdict);
    }
  }
  return failed;
}

}  // namespace irradiff
