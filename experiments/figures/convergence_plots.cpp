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

std::string errorSplitPlot(std::span<const ErrorSplitCurve> curves, Compared compared) {
  std::vector<const ErrorSplitCurve*> shown;
  for (const ErrorSplitCurve& curve : curves) {
    if (curve.compared == compared) shown.push_back(&curve);
  }
  constexpr std::size_t kColumns = 3;
  const std::size_t rows = (shown.size() + kColumns - 1) / kColumns;
  std::ostringstream script;
  script.precision(6);
  script << "set terminal svg size 900," << 60 + 260 * rows
         << " dynamic font 'Helvetica,Arial,sans-serif,12' background '#ffffff'\n"
         << "set encoding utf8\nset logscale x 2\nset xtics 16,16\nset format x '%g'\nset logscale y\n"
         << "set format y '10^{%T}'\nset yrange [1e-17:1e2]\nset ytics 1e-16,1e4\n"
         << "set grid xtics ytics lc '#dddddd' lt 1 lw 1\nset border 3 lc '#555555'\n"
         << "set tics nomirror tc '#000000'\nunset mytics\nunset mxtics\n";
  for (std::size_t i = 0; i < shown.size(); ++i) {
    script << "$split" << i << " << EOD\n";
    for (const ErrorSplitPoint& point : shown[i]->points) {
      script << point.rays;
      for (const double error :
           {point.medians.total, point.medians.discretisation, point.medians.noise, point.medians.rounding}) {
        // 0 has no place on a logarithmic axis, nor has what cannot be told.
        if (error > 0.0) {
          script << ' ' << error;
        } else {
          script << " NaN";
        }
      }
      script << '\n';
    }
    script << "EOD\n";
  }
  script << "set multiplot layout " << rows << ',' << kColumns << " margins 0.07,0.98,0.16,0.93 spacing 0.07,0.12\n";
  const std::array<const char*, 4> titles{"all", "discretisation", "noise", "rounding"};
  for (std::size_t i = 0; i < shown.size(); ++i) {
    script << "set title '" << shown[i]->estimator << "'\n";
    // One key for all, below the last panel of the first column.
    script << (i == kColumns * (rows - 1) ? "set key at screen 0.5,0.02 bottom center maxrows 1 Left reverse\n"
                                          : "unset key\n")
           << "plot ";
    for (std::size_t k = 0; k < titles.size(); ++k) {
      script << (k > 0 ? ", " : "") << "$split" << i << " using 1:" << k + 2 << " with linespoints lc '"
             << (k == 0 ? "#000000" : kColours[k - 1]) << "' lw " << (k == 0 ? 1 : 2) << " dt " << (k == 0 ? 2 : 1)
             << " pt " << kPointTypes[k] << " ps 0.5 title '" << titles[k] << "'";
    }
    script << '\n';
  }
  script << "unset multiplot\n";
  return runGnuplot(script.str());
}

}  // namespace irradiff
