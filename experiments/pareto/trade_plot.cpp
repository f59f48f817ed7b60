#include "experiments/pareto/trade_plot.h"

#include "verification/report/gnuplot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {

namespace {

/// Below the rounding of long double.
constexpr double kLowest = 1e-20;
constexpr double kHighest = 10.0;
constexpr std::size_t kColumns = 3;
constexpr int kPanelWidth = 400;
constexpr int kPanelHeight = 320;
constexpr int kKeyHeight = 130;

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

/// A panel in the making: its points by style, the front, and what both reach over.
class Panel {
 public:
  Panel(std::string name, std::string title, std::string x_title, std::string y_title)
      : name_(std::move(name)), title_(std::move(title)), x_title_(std::move(x_title)), y_title_(std::move(y_title)) {}

  void add(std::size_t series, double time, double error, bool on_front) {
    if (series >= series_.size()) series_.resize(series + 1);
    series_[series].emplace_back(time, drawn(error));
    if (on_front) front_.emplace_back(time, drawn(error));
  }

  /// `style(series)` is how gnuplot draws a series.
  template <class Style>
  void write(std::ostream& script, Style style) {
    std::ranges::sort(front_);
    writeBlock(script, "front", front_);
    for (std::size_t i = 0; i < series_.size(); ++i) writeBlock(script, std::to_string(i), series_[i]);
    const auto [left, right] = range(&Point::first, 1.25);
    const auto [low, high] = range(&Point::second, 4.0);
    script << "set title '" << title_ << "'\nset xlabel '" << x_title_ << "'\nset ylabel '" << y_title_
           << "'\nset xrange [" << left << ':' << right << "]\nset yrange [" << low << ':' << high << "]\nset ytics "
           << (high / low > 1e9 ? "1e-18,1e3" : "1e-18,10") << "\nplot NaN notitle";
    // A stair: nothing measured is below and left of it.
    if (!front_.empty()) script << ", $" << name_ << "_front using 1:2 with steps lc '#999999' lw 2 notitle";
    for (std::size_t i = 0; i < series_.size(); ++i) {
      if (!series_[i].empty()) script << ", $" << name_ << '_' << i << " using 1:2 " << style(i) << " notitle";
    }
    script << '\n';
  }

 private:
  using Point = std::pair<double, double>;

  void writeBlock(std::ostream& script, const std::string& suffix, const std::vector<Point>& points) const {
    if (points.empty()) return;
    script << '$' << name_ << '_' << suffix << " << EOD\n";
    for (const auto& [time, error] : points) script << time << ' ' << error << '\n';
    script << "EOD\n";
  }

  std::pair<double, double> range(double Point::*coordinate, double margin) const {
    double low = 1.0;
    double high = 10.0;
    bool is_first = true;
    for (const std::vector<Point>& points : series_) {
      for (const Point& point : points) {
        low = is_first ? point.*coordinate : std::min(low, point.*coordinate);
        high = is_first ? point.*coordinate : std::max(high, point.*coordinate);
        is_first = false;
      }
    }
    return {low / margin, high * margin};
  }

  std::string name_, title_, x_title_, y_title_;
  std::vector<std::vector<Point>> series_;
  std::vector<Point> front_;
};

std::string pointsOf(const PointStyle& style) {
  return std::string("with points lc '") + style.colour + "' pt " + std::to_string(style.type) + " ps 0.7";
}

std::string linesOf(const PointStyle& style) {
  return std::string("with linespoints lc '") + style.colour + "' lw 0.5 pt " + std::to_string(style.type) + " ps 0.7";
}

const PointStyle& estimatorStyle(std::size_t estimator) {
  return kEstimatorStyles[estimator % kEstimatorStyles.size()];
}

void writeFamilyPanel(std::ostream& script, const FamilyTrade& family, std::size_t number) {
  Panel panel("family" + std::to_string(number), family.family, "ns for a polygon", "99 % of the relative errors");
  for (const MethodTrade& method : family.methods) {
    if (method.compared == 0) continue;
    panel.add(static_cast<std::size_t>(method.group), method.nanoseconds.median,
              method.errors[kLargestError].percentile99, method.on_front);
  }
  panel.write(script, [](std::size_t group) { return pointsOf(kGroupStyles[group]); });
}

void writeEstimatorPanel(std::ostream& script, const Pareto& pareto, Compared compared) {
  const char* quantity = compared == Compared::kGradient ? "gradient" : "tangential Hessian";
  Panel panel(std::string("estimators_") + quantityOf(compared).name, std::string("samples, Figure 5: ") + quantity,
              "microseconds for a receiver", "median relative error");
  const std::vector<EstimatorChoice> choices = allEstimators();
  for (const EstimatorTrade& trade : pareto.estimators) {
    if (trade.compared != compared) continue;
    const auto choice = std::ranges::find(choices, trade.estimator.label(), &EstimatorChoice::label);
    panel.add(static_cast<std::size_t>(choice - choices.begin()), trade.microseconds.median, trade.errors.median,
              trade.on_front);
  }
  panel.write(script, [](std::size_t estimator) { return linesOf(estimatorStyle(estimator)); });
}

/// All keys below the panels, in a plot without axes.
void writeKeys(std::ostream& script) {
  script << "unset title\nunset xlabel\nunset ylabel\nunset logscale\nunset tics\nunset border\nunset grid\n"
         << "set xrange [0:1]\nset yrange [0:1]\n"
         << "set key at screen 0.5,screen 0.03 center horizontal maxrows 5 Left reverse samplen 1.2 font ',11'\n"
         << "set lmargin at screen 0.01\nset rmargin at screen 0.99\nset bmargin at screen 0.0\n"
         << "set tmargin at screen 0.05\nplot ";
  for (std::size_t group = 0; group < kMethodGroups; ++group) {
    script << "NaN " << pointsOf(kGroupStyles[group]) << " title '" << nameOf(static_cast<MethodGroup>(group)) << "', ";
  }
  script << "NaN with lines lc '#999999' lw 2 title 'Pareto front'";
  const std::vector<EstimatorChoice> choices = allEstimators();
  for (std::size_t e = 0; e < choices.size(); ++e) {
    script << ", NaN " << linesOf(estimatorStyle(e)) << " title '" << choices[e].label() << "'";
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
           << "\nset tmargin at screen " << top - 36.0 / height << "\nset bmargin at screen "
           << top - cell + 66.0 / height << '\n';
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
