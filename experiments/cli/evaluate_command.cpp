#include "experiments/cli/evaluate_command.h"

#include "derivatives/flatland/flatland_scene.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "experiments/cli/certified_text.h"
#include "experiments/cli/command_files.h"
#include "experiments/cli/evaluation_text.h"
#include "experiments/cli/progress.h"
#include "experiments/io/scene_file.h"
#include "experiments/io/scene_lines.h"
#include "experiments/io/spooled_text.h"
#include "experiments/io/whole_file.h"
#include "verification/certified/certified_flatland.h"
#include "verification/certified/certified_scene.h"
#include "verification/certified/ladder.h"
#include "verification/exact_boundary/exact_evaluation.h"

#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace irradiff {

namespace {

constexpr const char* kCommand = "evaluate";
constexpr const char* kStandardStream = "-";

enum class Method {
  kBoundary,
  kAppendix,
  kExact,
};

constexpr std::string_view kDouble = "double";
constexpr std::string_view kBall = "ball";
constexpr std::string_view kCertified = "certified";

struct EvaluateOptions {
  std::string input = kStandardStream;
  std::string output;  ///< standard output if empty
  Method method = Method::kBoundary;
  std::optional<double> tolerance;  ///< of certified precision; nothing for double
};

/// `append` writes the result at a receiver.
template <class ReceiverType, class Append>
void appendResults(const std::vector<ReceiverType>& receivers, const std::string& scene_name, Progress& progress,
                   SpooledText& line, Append append) {
  line.append("{\"results\":[");
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    std::string result = i > 0 ? "," : "";
    append(receivers[i], result);
    line.append(result);
    if (progress.isDue()) {
      progress.show(scene_name + ": " + std::to_string(i + 1) + " of " + std::to_string(receivers.size()) +
                    " receivers");
    }
  }
  line.append("]}");
}

void appendScene(const Scene& scene, const EvaluateOptions& options, const std::string& scene_name, Progress& progress,
                 SpooledText& line) {
  const auto appendAll = [&](const auto& receivers, auto append) {
    appendResults(receivers, scene_name, progress, line, append);
  };
  if (scene.dimension == 2) {
    if (options.method == Method::kAppendix) {
      throw SceneFileError("dimension: 2, must be 3 for the appendix form, which is one of polygons");
    }
    if (options.method == Method::kExact) {
      throw SceneFileError("dimension: 2, must be 3 for exact visibility, which is not built for flatland yet");
    }
    if (options.tolerance) {
      const double tolerance = *options.tolerance;
      appendAll(scene.flatland_receivers, [&scene, tolerance](const FlatlandReceiver& receiver, std::string& text) {
        appendCertifiedResult(certifyScene(scene.segments, receiver, tolerance), tolerance, text);
      });
      return;
    }
    appendAll(scene.flatland_receivers, [&scene](const FlatlandReceiver& receiver, std::string& text) {
      appendResult(evaluateScene(scene.segments, receiver), kDouble, {}, text);
    });
    return;
  }
  if (options.method == Method::kExact) {
    appendAll(scene.receivers, [&scene](const Receiver& receiver, std::string& text) {
      appendResult(evaluateExactly(scene.polygons, receiver), kBall, {}, text);
    });
    return;
  }
  const SceneEvaluator evaluator(scene.polygons);
  if (options.tolerance) {
    const double tolerance = *options.tolerance;
    appendAll(scene.receivers, [&evaluator, tolerance](const Receiver& receiver, std::string& text) {
      appendCertifiedResult(certifyScene(evaluator, receiver, tolerance), tolerance, text);
    });
    return;
  }
  const PolygonMethod form = options.method == Method::kAppendix ? PolygonMethod::kAppendix : PolygonMethod::kBoundary;
  appendAll(scene.receivers, [&evaluator, form](const Receiver& receiver, std::string& text) {
    appendResult(evaluator.evaluate(receiver, form), kDouble, {}, text);
  });
}

/// The lines of `in` as they are asked for, one for each scene, and how many scenes were refused.
class EvaluatedScenes {
 public:
  EvaluatedScenes(std::istream& in, const EvaluateOptions& options, Progress& progress)
      : in_(in), scenes_(in), options_(options), progress_(progress) {}

  /// False at the end of the scenes. Fails if they cannot be read. A line is known when its last receiver is: one that
  /// cannot be evaluated takes the place of all results. So a line is kept until then, rather than evaluated twice:
  /// writing it down takes less time than most evaluations.
  bool next(SpooledText& line) {
    line.clear();
    try {
      std::string text;
      if (!scenes_.next(text)) return false;
      const std::string scene_name = "scene " + std::to_string(count_);
      appendScene(parseScene(text), options_, scene_name, progress_, line);
      if (progress_.isDue()) progress_.show(std::to_string(count_ + 1) + " scenes");
    } catch (const std::bad_alloc&) {
      refuse("not enough memory for this scene", line);
    } catch (const std::exception& error) {
      if (!in_.good() && !in_.eof()) fail(kCommand, error.what());
      refuse(error.what(), line);
    }
    ++count_;
    return true;
  }

  std::size_t count() const { return count_; }
  std::size_t refusedCount() const { return refused_; }
  /// The first scene refused, and why.
  const std::string& firstRefusal() const { return first_refusal_; }

 private:
  void refuse(const std::string& message, SpooledText& line) {
    line.clear();
    line.append(errorLine(message));
    if (refused_++ == 0) first_refusal_ = "scene " + std::to_string(count_) + ": " + message;
  }

  std::istream& in_;
  SceneLines scenes_;
  const EvaluateOptions& options_;
  Progress& progress_;
  std::size_t count_ = 0;
  std::size_t refused_ = 0;
  std::string first_refusal_;
};

void evaluate(const EvaluateOptions& options) {
  std::ifstream file;
  if (options.input != kStandardStream) file = openInput(options.input);
  std::istream& in = options.input == kStandardStream ? std::cin : file;
  const std::unique_ptr<WholeFile> output_file = openOutput(options.output);
  std::ostream& out = output_file ? output_file->stream() : std::cout;

  Progress progress(!output_file && isatty(STDOUT_FILENO) == 1);
  EvaluatedScenes scenes(in, options, progress);
  for (SpooledText line; out && scenes.next(line);) {
    errno = 0;
    line.writeTo(out);
    // Whoever pipes scenes in one at a time gets each answer at once.
    out << std::endl;
    if (!out && !output_file) failToWrite(kCommand, errno);
  }
  if (scenes.count() == 0) {
    fail(kCommand, (options.input == kStandardStream ? "standard input" : options.input) +
                       " is empty, must hold at least one scene");
  }
  if (output_file) output_file->commit();
  if (scenes.refusedCount() > 0) {
    fail(kCommand, std::to_string(scenes.refusedCount()) + " of " + std::to_string(scenes.count()) +
                       " scenes could not be evaluated; first " + scenes.firstRefusal());
  }
}

}  // namespace

void addEvaluateCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(kCommand, "Irradiance and its derivatives at the receivers of scenes");
  const auto options = std::make_shared<EvaluateOptions>();
  command->add_option("FILE", options->input, "a scene, or JSON Lines with a scene a line; - is standard input")
      ->type_name("")
      ->capture_default_str();
  addOutputOption(*command, options->output, "where the results go, a JSON line for each scene");
  const auto method = std::make_shared<std::string>("boundary");
  command
      ->add_option("--method", *method,
                   "boundary: the production path; appendix: the form of the 2012 paper, for comparison, with the "
                   "boundary form's distance in its error bound; exact: visibility in rational numbers and "
                   "enclosures, slow, for polygons that are planar to the last bit")
      ->type_name("boundary|appendix|exact")
      ->check(CLI::IsMember({"boundary", "appendix", "exact"}).description(""))
      ->capture_default_str();
  const auto precision = std::make_shared<std::string>("double");
  command
      ->add_option("--precision", *precision,
                   "double: with error bounds; certified: with proven bounds that meet the tolerance, in double, "
                   "double-double or balls, whatever it takes at each source of light")
      ->type_name("double|certified")
      ->check(CLI::IsMember({kDouble, kCertified}).description(""))
      ->capture_default_str();
  const auto tolerance = std::make_shared<double>(kDefaultTolerance);
  command
      ->add_option("--tolerance", *tolerance,
                   "of certified precision: largest bound of irradiance, gradient and Hessian, each relative to its "
                   "largest entry; from 1e-60 to 1")
      ->type_name("T")
      ->check(CLI::Validator(
          [](const std::string& text) {
            double value = 0.0;
            if (!CLI::detail::lexical_cast(text, value)) return "tolerance: \"" + text + "\", must be a number";
            try {
              requireTolerance(value);
            } catch (const std::invalid_argument& error) {
              return std::string(error.what());
            }
            return std::string();
          },
          ""))
      ->capture_default_str();
  command->footer(
      "Exit status: 0 if every scene was evaluated, 1 if not, 2 for a wrong call. A scene that cannot be evaluated "
      "has\n"
      "{\"error\": \"...\"} in place of its results.");
  command->callback([options, method, precision, tolerance, command] {
    if (*precision == kCertified) {
      if (*method != "boundary") {
        throw CLI::ValidationError("--precision", "certified, must be double for --method " + *method);
      }
      options->tolerance = *tolerance;
    } else if (command->count("--tolerance") > 0) {
      throw CLI::ValidationError("--tolerance", "must come with --precision certified");
    }
    options->method = *method == "appendix" ? Method::kAppendix
                      : *method == "exact"  ? Method::kExact
                                            : Method::kBoundary;
    evaluate(*options);
  });
}

}  // namespace irradiff
