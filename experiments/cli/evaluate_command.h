#pragma once

namespace CLI {
class App;
}

namespace irradiff {

/// Adds `evaluate [FILE|-] [--output FILE] [--method boundary|appendix|exact] [--precision double]`: irradiance,
/// gradient and Hessian at the receivers of each scene in a file, a JSON line for each scene (evaluation_text.h). A
/// scene that cannot be evaluated gets {"error": "..."} as its line; the rest is evaluated, and the command throws
/// CLI::RuntimeError with status 1 at the end. It throws CLI::ValidationError for a file that cannot be opened.
void addEvaluateCommand(CLI::App& app);

}  // namespace irradiff
