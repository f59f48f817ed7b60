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
  std::ostringstream script;
  script.precision(6);
  script << "set terminal svg size 640,520 dynamic font 'Helvetica,Arial,sans-serif,15' background '#ffffff'\n"
         << "set encoding utf8\nset logscale xy\nset format '10^{%T}'\n"
         << "set xrange [1e" << inputs.first_decade << ":1e" << inputs.last_decade << "]\n"
         << "set yrange [" << kLowestDrawn << ':' << kHighestDrawn
         << "]\nset ytics 1e-16,100\nset xtics 100\nunset mytics\nunset mxtics\n"
         << "set xlabel " << quoted(inputs.axis_title) << " offset 0,0.5"
         << "\n"
         << "set ylabel 'relative error of the " << (quantity == Quantity::kGradient ? "gradient" : "Hessian")
         << " (1)'\n"
         << "set grid xtics ytics lc '#dddddd' lt 1 lw 1\nset border 3 lc '#555555'\nset tics nomirror tc '#000000'\n"
         << "set key below center horizontal Left reverse maxcols 2 samplen 2 spacing 1.15 width 1\n";
  for (std::size_t i = 0; i < curves.size(); ++i) {
    writeData(script, "curve" + std::to_string(i), curves[i]->points);
  }
  script << "plot " << kExtremePromise << " with lines lc '#555555' lw 1.5 dt 1 title 'promised, 10^{-13}'";
  for (std::size_t i = curves.size(); i-- > 0;) {
    const CurveStyle& style = kCurveStyles[i % kCurveStyles.size()];
    const std::string data = ", $curve" + std::to_string(i) + " using 1:";
    script << data << "2 with lines lc '" << style.colour << "' lw 1 dt 3 notitle";
    script << data << "3 with linespoints lc '" << style.colour << "' lw 2 pt " << style.point_type << " ps 0.5 title "
           << quoted(curves[i]->formula);
  }
  script << ", $curve0 using 1:4 with lines lc '#000000' lw 2 dt 2 title 'bound claimed by production'\n";
  return {inputs.file + '_' + quantity_name + ".svg",
          std::string("Error of the ") + (quantity == Quantity::kGradient ? "gradient" : "Hessian") + " against " +
              inputs.name,
          runGnuplot(script.str())};
}

}  // namespace irradiff
