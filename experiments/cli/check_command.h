#pragma once

namespace CLI {
class App;
}

namespace irradiff {

/// `irradiff check COMMAND`: holds a program of any language that answers scenes as `irradiff evaluate -` does against
/// all oracles (verification/checks/suite.h).
void addCheckCommand(CLI::App& app);

}  // namespace irradiff
