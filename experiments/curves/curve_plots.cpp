#include "experiments/curves/curve_plots.h"

#include "verification/report/gnuplot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace irradiff {

namespace {

/// Okabe and Ito's palette, told apart with any colour vision, and shapes of their own.
constexpr std::array<const char*, 8> kColours{"#E69F00", "#8C6D1F", "#CC79A7", "#56B4E9",
                                              "#0072B2", "#D55E00", "#000000", "#009E73"};
constexpr std::array<int, 8> kPointTypes{9, 11, 13, 6, 5, 7, 4, 8};
/// Ratios beyond are drawn at the border.
constexpr double kLeastRatio = 1e-3;
constexpr double kLargestRatio = 1e3;

enum class Axis { kRecords, kRays };

void writeCurveBlocks(std::ostream& script, const SceneStudy& scene, const std::vector<std::string>& metrics) {
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    script << "$curve" << m << " << EOD\n";
    for (const CurveBand& band : scene.curves.bands(metrics[m])) {
      // No error at all has no place on a logarithmic axis.
      if (!(band.lowest_rms > 0.0)) continue;
      script << band.records << ' ' << band.rays << ' ' << band.rms << ' ' << band.lowest_rms << ' ' << band.highest_rms
             << '\n';
    }
    script << "EOD\n";
  }
}

void writeCurvePanel(std::ostream& script, const SceneStudy& scene, const std::vector<std::string>& metrics,
                     Axis axis) {
  script << "set xlabel '" << (axis == Axis::kRecords ? "records" : "rays of all records") << "'\nplot NaN notitle";
  // What noise leaves where every receiver is gathered for itself.
  if (scene.rays_per_record > 0 && scene.gather_error > 0.0) {
    script << ", " << scene.gather_error << " with lines lc '#888888' dt 2 title 'a gather at every receiver'";
  }
  if (scene.known_gather_error) {
    script << ", " << *scene.known_gather_error << " with lines lc '#888888' dt 3 title 'the same, known geometry'";
  }
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    if (scene.curves.bands(metrics[m]).empty()) continue;
    const char* colour = kColours[m % kColours.size()];
    const char* x = axis == Axis::kRecords ? "1" : "2";
    script << ", $curve" << m << " using " << x << ":4:5 with filledcurves lc '" << colour << "' notitle, $curve" << m
           << " using " << x << ":3 with linespoints lc '" << colour << "' lw 2 pt "
           << kPointTypes[m % kPointTypes.size()] << " ps 0.7 title '" << metrics[m] << "'";
  }
  script << '\n';
}

/// A panel of ratios: a line from 5 to 95 %, a box from 25 to 75 %, a mark at the median.
struct RatioPanel {
  const char* title;
  const std::vector<double> RegionRatios::*values;
};
constexpr std::array<RatioPanel, 3> kRatioPanels{{{"radius / oracle's radius", &RegionRatios::radii},
                                                  {"true error / allowed by oracle", &RegionRatios::errors},
                                                  {"true error / promised", &RegionRatios::kept}}};

void writeRatioBlocks(std::ostream& script, const SceneStudy& scene) {
  for (std::size_t panel = 0; panel < kRatioPanels.size(); ++panel) {
    script << "$ratio" << panel << " << EOD\n";
    for (std::size_t m = 0; m < scene.ratios.size(); ++m) {
      const std::vector<double>& values = scene.ratios[m].*kRatioPanels[panel].values;
      const RatioQuantiles found = quantilesOf(values);
      if (found.values == 0) continue;
      script << scene.ratios.size() - m;
      for (const double quantile : found.quantiles) script << ' ' << std::clamp(quantile, kLeastRatio, kLargestRatio);
      script << " '" << scene.ratios[m].metric << "'\n";
    }
    script << "EOD\n";
  }
}

}  // namespace

std::string curvePlot(const SceneStudy& scene) {
  const std::vector<std::string> metrics = scene.curves.metrics();
  const bool has_rays = scene.rays_per_record > 0;
  std::ostringstream script;
  script.precision(6);
  script << "set terminal svg size " << (has_rays ? 1100 : 640)
         << ",520 dynamic font 'Helvetica,Arial,sans-serif,14' background '#ffffff'\n"
         << "set encoding utf8\nset logscale xy\nset format y '10^{%T}'\n"
         << "set ylabel 'RMS error over the mean irradiance'\n"
         << "set grid xtics ytics lc '#dddddd' lt 1 lw 1\nset border 3 lc '#555555'\nset tics nomirror tc '#000000'\n"
         << "set style fill transparent solid 0.18 noborder\n";
  writeCurveBlocks(script, scene, metrics);
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const CurvePoint& point : scene.curves.points) {
    if (!point.is_within) continue;
    low = std::min(low, static_cast<double>(point.records));
    high = std::max(high, static_cast<double>(point.records));
  }
  // One range, in records and in rays of so many records.
  const auto range = [&](double factor) {
    if (high > 0.0) script << "set xrange [" << 0.8 * factor * low << ':' << 1.25 * factor * high << "]\n";
  };
  script << "set key outside bottom center horizontal Left reverse samplen 1.6 width 1 font ',12'\n";
  if (has_rays) script << "set multiplot layout 1,2\n";
  script << "set format x '%g'\nset xtics add (50, 200, 500, 2000, 5000)\n";
  range(1.0);
  writeCurvePanel(script, scene, metrics, Axis::kRecords);
  if (has_rays) {
    script << "set format x '10^{%T}'\nunset ylabel\nset xtics autofreq\n";
    range(static_cast<double>(scene.rays_per_record));
    writeCurvePanel(script, scene, metrics, Axis::kRays);
    script << "unset multiplot\n";
  }
  return runGnuplot(script.str());
}

std::string ratioPlot(const SceneStudy& scene) {
  std::ostringstream script;
  script.precision(6);
  const std::size_t rows = std::max<std::size_t>(1, scene.ratios.size());
  script << "set terminal svg size 1100," << 110 + 34 * rows
         << " dynamic font 'Helvetica,Arial,sans-serif,13' background '#ffffff'\n"
         << "set encoding utf8\nset logscale x\nset xrange [" << kLeastRatio << ':' << kLargestRatio << "]\n"
         << "set format x '10^{%T}'\nset xtics 10\nset yrange [0.4:" << static_cast<double>(rows) + 0.6 << "]\n"
         << "set grid xtics lc '#dddddd' lt 1 lw 1\nset border 1 lc '#555555'\nset tics nomirror tc '#000000'\n"
         << "unset key\nunset mxtics\nset arrow 1 from 1,graph 0 to 1,graph 1 nohead lc '#D55E00' lw 2 back\n";
  writeRatioBlocks(script, scene);
  script << "set ytics (";
  for (std::size_t m = 0; m < scene.ratios.size(); ++m) {
    script << (m > 0 ? ", " : "") << '\'' << scene.ratios[m].metric << "' " << rows - m;
  }
  script << ") scale 0\nset multiplot\n";
  for (std::size_t panel = 0; panel < kRatioPanels.size(); ++panel) {
    const double left = 0.16 + 0.283 * static_cast<double>(panel);
    script << "set lmargin at screen " << left << "\nset rmargin at screen " << left + 0.26
           << "\nset tmargin at screen 0.86\nset bmargin at screen " << 44.0 / static_cast<double>(110 + 34 * rows)
           << "\nset title \"" << kRatioPanels[panel].title << "\" offset 0,-0.5\n";
    if (panel == 1) script << "unset ytics\n";
    const bool is_empty = std::ranges::all_of(scene.ratios, [&](const RegionRatios& ratios) {
      return quantilesOf(ratios.*kRatioPanels[panel].values).values == 0;
    });
    if (is_empty) {
      script << "plot NaN\n";
      continue;
    }
    script << "plot $ratio" << panel << " using 2:1:($6-$2):(0) with vectors nohead lc '#0072B2' lw 1.5, $ratio"
           << panel
           << " using 4:1:3:5:($1-0.25):($1+0.25) with boxxyerror lc '#0072B2' fs transparent solid 0.35, $ratio"
           << panel << " using 4:1 with points lc '#000000' pt 7 ps 0.6\n";
  }
  script << "unset multiplot\n";
  return runGnuplot(script.str());
}

}  // namespace irradiff
