#pragma once

#include "experiments/pareto/pareto.h"

#include <string>
#include <vector>

namespace irradiff {

/// What was measured, as sentences made of its numbers alone.
std::vector<std::string> paretoSentences(const Pareto& pareto);

/// index.html: one document without scripts or anything from the network, with the plot in it.
std::string paretoPage(const Pareto& pareto, const RunRecord& record, const std::string& svg);

}  // namespace irradiff
