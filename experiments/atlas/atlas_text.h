#pragma once

#include "experiments/atlas/atlas.h"

#include <string>
#include <vector>

namespace irradiff {

/// What errors and regions are, a paragraph each, as plain text.
std::vector<std::string> readingGuide();

/// How the errors of the formulas come about: a paragraph each.
std::vector<std::string> errorLaws();

/// How many regions there are, and what fresh inputs said of them.
std::string checkText(const Atlas& atlas);

/// atlas.md: all of this with a table of the Hessian's regions for each map, as docs/atlas.md has it.
std::string atlasMarkdown(const Atlas& atlas, const RunRecord& record);

}  // namespace irradiff
