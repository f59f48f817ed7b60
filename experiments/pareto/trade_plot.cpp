#include "experiments/pareto/trade_plot.h"

#include "verification/report/gnuplot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

namespace irradiff {

namespace {

constexpr double kLowest = 1e-18;
constexpr double kHighest = 10.0;
constexpr std::size_t kColumns = 3;
constexpr int kPanelWidth = 400;
constexpr int kPanelHeight = 320;
constexpr int kKeyHeight = 90;

/// Okabe and Ito's palette, told apart with any colour vision, and shapes of their own.
struct PointStyle {
  const char* colour;
  int type;
};
constexpr std::array<PointStyle, kMethodGroups> kGroupStyles = {
    {{"#E69F00", 9}, {"#0072B2", 5}, {"#009E73", 11}, {"#000000", 7}, {"#CC79A7", 4}, {"#D55E00", 13}, {"#56B4E9", 3}}};
constexpr std::array<PointStyle, 9> kEstimatorStyles = {{{"#0072B2", 7},
                                                         {"#D55E00", 5},
                                                         {"#009E73", 9},
                                                         {"#CC79A7", 11},
                                                         {"#E69F00", 13},
                                                         {"#56B4E9", 6},
                                                         {"#000000", 4},
                                                         {"#8C6D1F", 8},
                                                         {"#888888", 10}}};

double drawn(double error) { return std::isnan(error) ? kHighest : std::clamp(error, kLowest, kHighest); }

using FrontPoints = std::vector<std::pair<double, double>>;

/// A stair: nothing measured is below and left of it.
void writeFront(std::ostream& script, FrontPoints front, const std::string& name) {
  std::ranges::sort(front);
  script << '$' << name << " << EOD\n";
  for (const auto& [time, error] : front) script << time << ' ' << drawn(error) << '\n';
  script << "EOD\n";
}

const char* kFrontLine = " with steps lc '#999999' lw 2 notitle";

std::string pointsOf(const PointStyle& style) {
  return std::string(" with points lc '") + style.colour + "' pt " + std::to_string(style.type) + " ps 0.7 ";
}

void writeFamilyPanel(std::ostream& script, const FamilyTrade& family, std::size_t number) {
  const std::string data = "family" + std::to_string(number);
  FrontPoints front;
  for (std::size_t group = 0; group < kMethodGroups; ++group) {
    script << '$' << data << '_' << group << " << EOD\n";
    for (const MethodTrade& method : family.methods) {
      if (static_cast<std::size_t>(method.group) != group || method.compared == 0) continue;
      const double error = method.errors[kLargestError].percentile99;
      script << method.nanoseconds.median << ' ' << drawn(error) << '\n';
      if (method.on_front) front.emplace_back(method.nanoseconds.median, error);
    }
    // A block without points is an error.
    script << "NaN NaN\nEOD\n";
  }
  writeFront(script, front, data + "_front");
  script << "set title '" << family.family << "'\nset xlabel 'ns for a polygon'\n"
         << "set ylabel '99 % of the relative errors'\nset yrange [1e-18:20]\nset ytics 1e-18,1e3\n"
         << "plot $" << data << "_front using 1:2" << kFrontLine;
  for (std::size_t group = 0; group < kMethodGroups; ++group) {
    script << ", $" << data << '_' << group << " using 1:2" << pointsOf(kGroupStyles[group]) << "notitle";
  }
  script << '\n';
}

void writeEstimatorPanel(std::ostream& script, const Pareto& pareto, Compared compared) {
  const std::string data = std::string("estimators_") + quantityOf(compared).name;
  const std::vector<EstimatorChoice> choices = allEstimators();
  FrontPoints front;
  for (std::size_t e = 0; e < choices.size(); ++e) {
    script << '$' << data << '_' << e << " << EOD\n";
    for (const EstimatorTrade& trade : pareto.estimators) {
      if (trade.compared != compared || trade.estimator.label() != choices[e].label()) continue;
      script << trade.microseconds.median << ' ' << drawn(trade.errors.median) << '\n';
      if (trade.on_front) front.emplace_back(trade.microseconds.median, trade.errors.median);
    }
    script << "NaN NaN\nEOD\n";
  }
  writeFront(script, front, data + "_front");
  script << "set title 'samples, Figure 5: " << (compared == Compared::kGradient ? "gradient" : "tangential Hessian")
         << "'\nset xlabel 'microseconds for a receiver'\nset ylabel 'median relative error'\n"
         << "set yrange [*:*]\nset ytics auto\nplot $" << data << "_front using 1:2" << kFrontLine;
  for (std::size_t e = 0; e < choices.size(); ++e) {
    const PointStyle& style = kEstimatorStyles[e % kEstimatorStyles.size()];
    script << ", $" << data << '_' << e << " using 1:2 with linespoints lc '" << style.colour << "' lw 0.5 pt "
           << style.type << " ps 0.6 notitle";
  }
  script << '\n';
}

/// All keys below the panels, in a plot without axes.
void writeKeys(std::ostream& script) {
  script << "unset title\nunset xlabel\nunset ylabel\nunset logscale\nunset tics\nunset border\nunset grid\n"
         << "set xrange [0:1]\nset yrange [0:1]\n"
         << "set key at screen 0.5,screen 0.055 center horizontal maxrows 3 Left reverse samplen 1.2 font ',11'\n"
         << "set lmargin at screen 0.01\nset rmargin at screen 0.99\nset bmargin at screen 0.0\n"
         << "set tmargin at screen 0.05\nplot ";
  for (std::size_t group = 0; group < kMethodGroups; ++group) {
    script << "NaN" << pointsOf(kGroupStyles[group]) << "title '" << nameOf(static_cast<MethodGroup>(group)) << "', ";
  }
  script << "NaN with lines lc '#999999' lw 2 title 'Pareto front'";
  const std::vector<EstimatorChoice> choices = allEstimators();
  for (std::size_t e = 0; e < choices.size(); ++e) {
    const PointStyle& style = kEstimatorStyles[e % kEstimatorStyles.size()];
    script << ", NaN with linespoints lc '" << style.colour << "' lw 0.5 pt " << style.type << " ps 0.7 title '"
           << choices[e].label() << "'";
  }
  script << '\n';
}

}  // namespace

std::string tradePlot(const Pareto& pareto) {
  const std::size_t panels = pareto.families.size() + 2;
  const std::size_t rows = (panels + kColumns - 1) / kColumns;
  const auto height = static_cast<double>(kPanelHeight * static_cast<int>(rows) + kKeyHeight);
  std::ostringstream script;
  script.precision(6);
  script << "set terminal svg size " << kPanelWidth * static_cast<int>(kColumns) << ',' << height
         << " dynamic font 'Helvetica,Arial,sans-serif,12' background '#ffffff'\n"
         << "set encoding utf8\nset logscale xy\nset format x '10^{%T}'\nset format y '10^{%T}'\n"
         << "set grid xtics ytics lc '#dddddd' lt 1 lw 1\nset border 3 lc '#555555'\n"
         << "set tics nomirror tc '#000000'\nset xlabel offset 0,0.4\nunset mxtics\nunset mytics\nunset key\n";
  script << "set multiplot\n";
  std::size_t place = 0;
  const double cell = (1.0 - kKeyHeight / height) / static_cast<double>(rows);
  const auto nextPanel = [&] {
    const std::size_t row = place / kColumns;
    const std::size_t column = place % kColumns;
    ++place;
    const double left = static_cast<double>(column) / static_cast<double>(kColumns);
    const double top = 1.0 - static_cast<double>(row) * cell;
    script << "set lmargin at screen " << left + 0.065 << "\nset rmargin at screen " << left + 0.32
           << "\nset tmargin at screen " << top - 30.0 / height << "\nset bmargin at screen "
           << top - cell + 64.0 / height << '\n';
  };
  for (std::size_t i = 0; i < pareto.families.size(); ++i) {
    nextPanel();
    writeFamilyPanel(script, pareto.families[i], i);
  }
  for (const Compared compared : {Compared::kGradient, Compared::kHessian}) {
    nextPanel();
    writeEstimatorPanel(script, pareto, compared);
  }
  writeKeys(script);
  script << "unset multiplot\n";
  return runGnuplot(script.str());
}

}  // namespace irradiff
