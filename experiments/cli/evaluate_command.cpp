#include "experiments/cli/evaluate_command.h"

#include "derivatives/flatland/flatland_scene.h"
#include "derivatives/visibility/scene_evaluation.h"
#include "experiments/cli/command_files.h"
#include "experiments/cli/evaluation_text.h"
#include "experiments/cli/progress.h"
#include "experiments/io/scene_file.h"
#include "experiments/io/scene_lines.h"
#include "experiments/io/spooled_text.h"
#include "experiments/io/whole_file.h"
#include "verification/exact_boundary/exact_evaluation.h"

#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <memory>
#include <new>
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

struct EvaluateOptions {
  std::string input = kStandardStream;
  std::string output;  ///< standard output if empty
  Method method = Method::kBoundary;
};

template <class Evaluate, class ReceiverType>
void appendResults(const std::vector<ReceiverType>& receivers, std::string_view precision,
                   const std::string& scene_name, Progress& progress, SpooledText& line, Evaluate evaluate) {
  line.append("{\"results\":[");
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    std::string result = i > 0 ? "," : "";
    appendResult(evaluate(receivers[i]), precision, result);
    line.append(result);
    if (progress.isDue()) {
      progress.show(scene_name + ": " + std::to_string(i + 1) + " of " + std::to_string(receivers.size()) +
                    " receivers");
    }
  }
  line.append("]}");
}

void appendScene(const Scene& scene, Method method, const std::string& scene_name, Progress& progress,
                 SpooledText& line) {
  if (scene.dimension == 2) {
    if (method == Method::kAppendix) {
      throw SceneFileError("dimension: 2, must be 3 for the appendix form, which is one of polygons");
    }
    if (method == Method::kExact) {
      throw SceneFileError("dimension: 2, must be 3 for exact visibility, which is not built for flatland yet");
    }
    appendResults(scene.flatland_receivers, kDouble, scene_name, progress, line,
                  [&scene](const FlatlandReceiver& receiver) { return evaluateScene(scene.segments, receiver); });
    return;
  }
  if (method == Method::kExact) {
    appendResults(scene.receivers, kBall, scene_name, progress, line,
                  [&scene](const Receiver& receiver) { return evaluateExactly(scene.polygons, receiver); });
    return;
  }
  const SceneEvaluator evaluator(scene.polygons);
  const PolygonMethod form = method == Method::kAppendix ? PolygonMethod::kAppendix : PolygonMethod::kBoundary;
  appendResults(scene.receivers, kDouble, scene_name, progress, line,
                [&evaluator, form](const Receiver& receiver) { return evaluator.evaluate(receiver, form); });
}

/// The lines of `in` as they are asked for, one for each scene, and how many scenes were refused.
class SceneEvaluator {
 public:
  SceneEvaluator(std::istream& in, Method method, Progress& progress)
      : in_(in), scenes_(in), method_(method), progress_(progress) {}

  /// False at the end of the scenes. Fails if they cannot be read. A line is known when its last receiver is: one that
  /// cannot be evaluated takes the place of all results. So a line is kept until then, rather than evaluated twice:
  /// writing it down takes less time than most evaluations.
  bool next(SpooledText& line) {
    line.clear();
    try {
      std::string text;
      if (!scenes_.next(text)) return false;
      const std::string scene_name = "scene " + std::to_string(count_);
      appendScene(parseScene(text), method_, scene_name, progress_, line);
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
  Method method_;
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
  SceneEvaluator evaluator(in, options.method, progress);
  for (SpooledText line; out && evaluator.next(line);) {
    errno = 0;
    line.writeTo(out);
    // Whoever pipes scenes in one at a time gets each answer at once.
    out << std::endl;
    if (!out && !output_file) failToWrite(kCommand, errno);
  }
  if (evaluator.count() == 0) {
    fail(kCommand, (options.input == kStandardStream ? "standard input" : options.input) +
                       " is empty, must hold at least one scene");
  }
  if (output_file) output_file->commit();
  if (evaluator.refusedCount() > 0) {
    fail(kCommand, std::to_string(evaluator.refusedCount()) + " of " + std::to_string(evaluator.count()) +
                       " scenes could not be evaluated; first " + evaluator.firstRefusal());
  }
}

/// Refuses one value, saying what it waits for.
CLI::Validator refusalOf(const std::string& value, const std::string& reason) {
  return CLI::Validator([value, reason](const std::string& given) { return given == value ? reason : std::string(); },
                        "");
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
  command->add_option("--precision", *precision, "what is computed with, here double alone")
      ->type_name("double")
      ->check(refusalOf("certified", "certified precision is not built yet; double is"))
      ->check(CLI::IsMember({"double"}).description(""))
      ->capture_default_str();
  // Hidden: whoever asks for it learns what is missing.
  command->add_option("--tolerance")->group("")->each([](const std::string&) {
    throw CLI::ValidationError("--tolerance", "comes with certified precision, which is not built yet");
  });
  command->footer(
      "Exit status: 0 if every scene was evaluated, 1 if not, 2 for a wrong call. A scene that cannot be evaluated "
      "has\n"
      "{\"error\": \"...\"} in place of its results.");
  command->callback([options, method, precision] {
    options->method = *method == "appendix" ? Method::kAppendix
                      : *method == "exact"  ? Method::kExact
                                            : Method::kBoundary;
    evaluate(*options);
  });
}

}  // namespace irradiff
