#pragma once

namespace CLI {
class App;
}

namespace irradiff {

/// Adds `pareto --output DIR [--effort quick|standard|full] [--seed N] [--family NAME]...`: time and error of every
/// formula, rule and estimator. Throws CLI::ValidationError for a family that does not exist and a folder that must not
/// be replaced.
void addParetoCommand(CLI::App& app);

}  // namespace irradiff
