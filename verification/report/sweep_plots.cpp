#include "verification/report/sweep_plots.h"

#include "verification/report/gnuplot.h"
#include "verification/report/headline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace irradiff {
namespace {

constexpr double kLowestDrawn = 1e-17;
constexpr double kHighestDrawn = 10.0;

/// Okabe and Ito's palette, told apart with any colour vision; the promised formula comes first.
struct CurveStyle {
  const char* colour;
  int point_type;
};
constexpr std::array<CurveStyle, 4> kCurveStyles = {{{"#0072B2", 7}, {"#009E73", 5}, {"#E69F00", 9}, {"#D55E00", 11}}};

double drawn(double error) {
  return std::isnan(error) ? kHighestDrawn : std::clamp(error, kLowestDrawn, kHighestDrawn);
}

void writeData(std::ostream& script, const std::string& name, const std::vector<SweepPoint>& points) {
  script << '$' << name << " << EOD\n";
  for (const SweepPoint& point : points) {
    script << point.size << ' ' << drawn(point.median) << ' ' << drawn(point.peak) << ' ' << drawn(point.bound) << '\n';
  }
  script << "EOD\n";
}

/// Inside single quotes of a gnuplot script.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    result += c;
    if (c == '\'') {
      result += c;
    }
  }
  return result + "'";
}

}  // namespace

SweepPlot plotSweep(const ErrorSweep& sweep, Quantity quantity) {
  const SweepInputs& inputs = *sweep.inputs;
  const std::string quantity_name = quantity == Quantity::kGradient ? "gradient" : "hessian";
  std::vector<const SweepCurve*> curves;
  for (const SweepCurve& curve : sweep.curves) {
    if (curve.quantity == quantity) {
      curves.push_back(&curve);
    }
  }
  const char* quantity_title = quantity == Quantity::kGradient ? "gradient" : "Hessian";
  const double promise = quantity == Quantity::kGradient ? inputs.gradient_promise : inputs.hessian_promise;
  std::ostringstream script;
  script.precision(6);
  // About as wide as a column of the page on a desktop, so that the letters are still legible on a phone.
  script
      << "set terminal svg size 540,460 dynamic font 'Helvetica,Arial,sans-serif,14' background '#ffffff'\n"
      << "set encoding utf8\nset logscale xy\nset format '10^{%T}'\n"
      << "set xrange [1e" << inputs.first_decade << ":1e" << inputs.last_decade << "]\n"
      << "set yrange [" << kLowestDrawn << ':' << kHighestDrawn
      << "]\nset ytics 1e-16,100\nset xtics 100\nunset mytics\nunset mxtics\n"
      << "set xlabel " << quoted(inputs.axis_title) << " offset 0,0.3\n"
      << "set ylabel 'relative error of the " << quantity_title << " (1)' offset 0.5,0\n"
      << "set grid xtics ytics lc '#dddddd' lt 1 lw 1\nset border 3 lc '#555555'\nset tics nomirror tc '#000000'\n"
      << "set lmargin 8.5\nset rmargin 2\nset tmargin 0.8\nset bmargin 7.2\n"
      << "set key at screen 0.5,0.015 bottom center vertical maxrows 3 Left reverse samplen 1.6 spacing 1.15 width -9 "
         "font ',13'\n";
  for (std::size_t i = 0; i < curves.size(); ++i) {
    writeData(script, "curve" + std::to_string(i), curves[i]->points);
  }
  // The key begins with the promised formula, which is drawn last, on top of the others.
  const std::string line_of_promise = " with lines lc '#555555' lw 1.5 dt 1";
  const std::string line_of_bound = " with lines lc '#000000' lw 2 dt 2";
  const auto line_of_peak = [](std::size_t i) {
    const CurveStyle& style = kCurveStyles[i % kCurveStyles.size()];
    return std::string(" with linespoints lc '") + style.colour + "' lw 2 pt " + std::to_string(style.point_type) +
           " ps 0.5";
  };
  script << "plot keyentry" << line_of_peak(0) << " title " << quoted(curves[0]->formula + " (edge rule)")
         << ", keyentry" << line_of_bound << " title 'the bound it claims'"
         << ", keyentry" << line_of_promise << " title "
         << (promise > 0.0 ? "'promised: 10^{-13}'" : "'10^{-13}, not promised here'");
  for (std::size_t i = 1; i < curves.size(); ++i) {
    script << ", keyentry" << line_of_peak(i) << " title " << quoted(curves[i]->formula);
  }
  script << ", " << kExtremePromise << line_of_promise << " notitle";
  for (std::size_t i = curves.size(); i-- > 0;) {
    const std::string data = ", $curve" + std::to_string(i) + " using 1:";
    script << data << "2 with lines lc '" << kCurveStyles[i % kCurveStyles.size()].colour << "' lw 1 dt 3 notitle"
           << data << '3' << line_of_peak(i) << " notitle";
  }
  script << ", $curve0 using 1:4" << line_of_bound << " notitle\n";
  return {inputs.file + '_' + quantity_name + ".svg",
          std::string("Error of the ") + quantity_title + " against " + inputs.name, runGnuplot(script.str())};
}

}  // namespace irradiff
