#pragma once

#include "verification/report/accuracy_report.h"

#include <string>

namespace irradiff {

/// The summary and the table by family as Markdown: docs/accuracy.md. Names no date and no machine, so that it changes
/// only with the figures.
std::string accuracyMarkdown(const AccuracyReport& report);

}  // namespace irradiff
