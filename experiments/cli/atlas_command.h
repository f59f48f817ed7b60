#pragma once

namespace CLI {
class App;
}

namespace irradiff {

/// Adds `atlas --output DIR [--effort quick|standard|full] [--seed N] [--threads N]`: where each formula is safe
/// (experiments/atlas/atlas.h). The folder appears whole or not at all; a run that was killed leaves its finished rows
/// in DIR.part, and the same call goes on from there. Throws CLI::ValidationError for a wrong argument and a folder
/// that must not be replaced, and CLI::RuntimeError with status 1, having said which, where an inequality fails.
void addAtlasCommand(CLI::App& app);

}  // namespace irradiff
