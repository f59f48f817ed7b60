#include "experiments/figures/convergence_plots.h"

#include "verification/report/gnuplot.h"

#include <array>
#include <cmath>
#include <sstream>
#include <vector>

namespace irradiff {
namespace {

/// Okabe and Ito's palette, told apart with any colour vision; grey comes last.
constexpr std::array<const char*, 9> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00",
                                              "#56B4E9", "#000000", "#8C6D1F", "#888888"};
constexpr std::array<int, 9> kPointTypes{7, 5, 9, 11, 13, 6, 4, 8, 10};

}  // namespace

std::string convergencePlot(std::span<const ConvergenceCurve> curves, Compared compared) {
  std::vector<const ConvergenceCurve*> shown;
  for (const ConvergenceCurve& curve : curves) {
    if (curve.compared == compared) shown.push_back(&curve);
  }
  const char* quantity = compared == Compared::kGradient ? "gradient" : "tangential Hessian";
  std::ostringstream script;
  script.precision(6);
  script << "set terminal svg size 640,520 dynamic font 'Helvetica,Arial,sans-serif,14' background '#ffffff'\n"
         << "set encoding utf8\nset logscale x 2\nset logscale y\nset format y '10^{%T}'\n"
         << "set xlabel 'rays at a receiver'\nset ylabel 'median relative error of the " << quantity << " (1)'\n"
         << "set grid xtics ytics lc '#dddddd' lt 1 lw 1\nset border 3 lc '#555555'\nset tics nomirror tc '#000000'\n"
         << "set key outside bottom center horizontal Left reverse samplen 1.6 width 1 font ',12'\n"
         << "set style fill transparent solid 0.18 noborder\n";
  for (std::size_t i = 0; i < shown.size(); ++i) {
    script << "$curve" << i << " << EOD\n";
    for (const ConvergencePoint& point : shown[i]->points) {
      // An error of 0 has no place on a logarithmic axis.
      if (!(point.low() > 0.0)) continue;
      script << point.rays << ' ' << point.median() << ' ' << point.low() << ' ' << point.high() << '\n';
    }
    script << "EOD\n";
  }
  script << "plot ";
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const char* colour = kColours[i % kColours.size()];
    script << (i > 0 ? ", " : "") << "$curve" << i << " using 1:3:4 with filledcurves lc '" << colour << "' notitle, "
           << "$curve" << i << " using 1:2 with linespoints lc '" << colour << "' lw 2 pt "
           << kPointTypes[i % kPointTypes.size()] << " ps 0.6 title '" << shown[i]->estimator.label() << "'";
  }
  script << '\n';
  return runGnuplot(script.str());
}

}  // namespace irradiff
