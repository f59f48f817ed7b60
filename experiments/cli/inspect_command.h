#pragma once

namespace CLI {
class App;
}

namespace irradiff {

/// Adds `inspect [FILE|-] [--output FILE] [--tolerance T] [--json]`: what each scene in a file needs at its receivers
/// and why, as a text, or with --json as a JSON line for each scene, {"summary": {...}, "points": [...]}
/// (inspection_text.h). A scene that cannot be evaluated gets an error in its place, the rest is inspected, and the
/// command throws CLI::RuntimeError with status 1 at the end. It throws CLI::ValidationError for a file that cannot be
/// opened.
void addInspectCommand(CLI::App& app);

}  // namespace irradiff
