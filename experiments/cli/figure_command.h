#pragma once

namespace CLI {
class App;
}

namespace irradiff {

/// Adds `figure 5 --analytic --output DIR [--scene FILE] [--resolution N] [--threads N]`: the exact maps of Figure 5 of
/// the 2012 paper, of its scene or another with a grid (experiments/figures/analytic_figure.h). The folder appears
/// whole or not at all. Throws CLI::ValidationError for a wrong argument and a folder that must not be replaced, and
/// CLI::RuntimeError with status 1, having said why, where the scene cannot be evaluated.
void addFigureCommand(CLI::App& app);

}  // namespace irradiff
