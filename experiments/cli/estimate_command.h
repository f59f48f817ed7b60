#pragma once

namespace CLI {
class App;
}

namespace irradiff {

/// Adds `estimate FILE|- --estimator NAME [--output FILE]`: irradiance and its derivatives as an estimator gets them
/// from the hemisphere samples in a file (samples_file.h), a JSON line for each record (estimate_text.h). A record that
/// is wrong or that the estimator cannot take gets {"error": "..."} as its line; the rest is estimated, and the command
/// throws CLI::RuntimeError with status 1 at the end. It throws CLI::ValidationError for an unknown estimator and for a
/// file that cannot be opened.
void addEstimateCommand(CLI::App& app);

}  // namespace irradiff
