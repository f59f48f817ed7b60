#pragma once

namespace CLI {
class App;
}

namespace irradiff {

/// Adds `curves [FILE] --output DIR [--effort quick|standard|full] [--metric NAME]... [--seed S] [--threads T]`: error
/// against the number of records for all metrics, regions beside the oracle's, and the paper's figures. Throws
/// CLI::ValidationError for a file that cannot be used, an unknown metric and a folder that must not be replaced.
void addCurvesCommand(CLI::App& app);

}  // namespace irradiff
