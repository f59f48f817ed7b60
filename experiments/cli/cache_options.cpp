#include "experiments/cli/cache_options.h"

#include "experiments/cache/placement.h"
#include "experiments/cli/bounded_number.h"
#include "experiments/cli/metric_option.h"
#include "experiments/cli/run_options.h"
#include "experiments/cli/whole_number.h"

#include <cmath>
#include <stdexcept>

namespace irradiff {

namespace {

constexpr unsigned kMostReceivers = 1U << 20U;
/// Every estimator works with so many.
constexpr unsigned kFewestRays = 16;
constexpr unsigned kMostRays = 1U << 20U;

/// What of an option's name is wrong, empty for nothing: `parse` throws std::invalid_argument.
template <class Parse>
CLI::Validator nameFor(const Parse& parse) {
  return CLI::Validator(
      [parse](const std::string& name) {
        try {
          static_cast<void>(parse(name));
          return std::string();
        } catch (const std::invalid_argument& error) {
          return std::string(error.what());
        }
      },
      "");
}

/// A threshold must be positive: a record that keeps an error of nothing serves nobody.
std::string wrongThreshold(const std::string& given) {
  double value = 0.0;
  const bool is_right = CLI::detail::lexical_cast(given, value) && value > 0.0 && std::isfinite(value);
  return is_right ? "" : '"' + given + "\" must be a number greater than 0";
}

void addMetricOptions(CLI::App& command, CacheArguments& arguments) {
  command.add_option("--metric", arguments.metric, "error metric")
      ->check(wrongMetric, "")
      ->type_name("NAME")
      ->capture_default_str();
  CLI::Option* threshold = command
                               .add_option("--threshold", arguments.threshold,
                                           "what the metric keeps the error at; its unit is the metric's")
                               ->check(wrongThreshold, "")
                               ->type_name("EPS");
  command
      .add_option("--records", arguments.records,
                  "number of records that the threshold is tuned for, to 2 %; 1000 without, or an eighth of the "
                  "receivers")
      ->check(wholeNumber(1, kMostReceivers))
      ->excludes(threshold)
      ->type_name("N");
  command.add_option("--scale", arguments.scale, "absolute errors or shares of the record's irradiance")
      ->check(nameFor(errorScaleOf))
      ->type_name("absolute|relative")
      ->capture_default_str();
  command.add_option("--measure", arguments.measure, "the error's integral over the region or its mean")
      ->check(nameFor(errorMeasureOf))
      ->type_name("total|mean")
      ->capture_default_str();
  command.add_option("--ellipse", arguments.ellipse, "how a Hessian becomes an ellipse")
      ->check(nameFor(ellipseRuleOf))
      ->type_name("printed|equal-error|equal-error-exact")
      ->capture_default_str();
  command.add_option("--aspect", arguments.aspect, "longer half-axis over the shorter, at most")
      ->check(boundedNumber(1.0, 1000.0))
      ->type_name("A")
      ->capture_default_str();
  CLI::Option* known = command.add_flag_callback(
      "--known-geometry", [&arguments] { arguments.knows_geometry = true; },
      "irradiance and gradients of a room's records with exact visibility of its polygons; so for second-order without "
      "either");
  command
      .add_flag_callback(
          "--no-known-geometry", [&arguments] { arguments.knows_geometry = false; },
          "from samples alone; so for all other metrics")
      ->excludes(known);
}

void addPlacementOptions(CLI::App& command, CacheArguments& arguments) {
  command.add_option("--order", arguments.order, "in which order pixels are asked for")
      ->check(nameFor(placementOrderOf))
      ->type_name("rows|refining")
      ->capture_default_str();
  command.add_flag("--overture,!--no-overture", arguments.has_overture,
                   "interpolate all pixels anew when all records are there; so without either");
  command.add_flag("--clamp-neighbours", arguments.clamps_neighbours,
                   "no region larger than a neighbour's plus the distance");
  command.add_option("--passes", arguments.passes, "of progressive refinement")
      ->check(wholeNumber(1, 16))
      ->type_name("P")
      ->capture_default_str();
  command.add_option("--most-records", arguments.most_records, "stop there; the status is then 1")
      ->check(wholeNumber(1, kMostReceivers))
      ->type_name("N");
}

}  // namespace

void addCacheOptions(CLI::App& command, CacheArguments& arguments) {
  command.add_option("FILE", arguments.file, "a room (irradiff-room), or a scene with a grid (irradiff-scene)")
      ->required()
      ->type_name("");
  addFolderOption(command, arguments.output, "of the results; earlier ones there");
  addMetricOptions(command, arguments);
  addPlacementOptions(command, arguments);
  command
      .add_option("--rays", arguments.rays,
                  "rays for each record, rounded down to a square; 4096 without, of a scene with a grid none: exact")
      ->check(wholeNumber(kFewestRays, kMostRays))
      ->type_name("N");
  command
      .add_option("--width", arguments.width,
                  "pixels along the image's side, or receivers along a grid's or on all walls of flatland; 256 "
                  "without, in flatland 4096")
      ->check(wholeNumber(1, kMostReceivers))
      ->type_name("W");
  addSeedOption(command, arguments.seed);
  addThreadsOption(command, arguments.threads);
}

}  // namespace irradiff
