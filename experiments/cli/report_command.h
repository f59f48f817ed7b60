#pragma once

namespace CLI {
class App;
}

namespace irradiff {

/// Adds `report --output DIR [--effort quick|standard|full] [--seed N] [--threads N] [--reference DIR]`: the accuracy
/// report of the library's formulas, and Figure 5 in its folder figure5/. Throws CLI::RuntimeError with status 1 if a
/// promise is broken (the report is written all the same), CLI::ValidationError for a folder that must not be replaced.
void addReportCommand(CLI::App& app);

}  // namespace irradiff
