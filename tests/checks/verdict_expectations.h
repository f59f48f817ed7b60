#pragma once

#include "verification/checks/verdict.h"

#include <string>
#include <vector>

namespace irradiff {

/// Expects that all verdicts passed, that there are some, and that each saw inputs.
void expectAllPass(const std::vector<Verdict>& verdicts);

/// Expects that the verdicts on the quantity failed and all others passed, and that those that failed say what went
/// wrong: an error above the tolerance, expected and actual value, and a worst input that the scene reader reads.
/// `likely_cause` must occur in what they name as cause; empty for any.
void expectOnlyRejected(Quantity quantity, const std::vector<Verdict>& verdicts, const std::string& likely_cause);

}  // namespace irradiff
