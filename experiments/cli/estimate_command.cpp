#include "experiments/cli/estimate_command.h"

#include "derivatives/estimators/estimator.h"
#include "experiments/cli/command_files.h"
#include "experiments/cli/estimate_text.h"
#include "experiments/cli/evaluation_text.h"
#include "experiments/cli/progress.h"
#include "experiments/io/samples_file.h"
#include "experiments/io/whole_file.h"

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
#include <unistd.h>
#include <utility>

namespace irradiff {

namespace {

constexpr const char* kCommand = "estimate";
constexpr const char* kStandardStream = "-";

struct EstimateOptions {
  std::string input;
  std::string estimator;
  std::string output;  ///< standard output if empty
};

std::string estimatorNames(const std::string& separator) {
  std::string names;
  for (const EstimatorDescription& description : estimatorDescriptions()) {
    names += (names.empty() ? "" : separator) + std::string(description.name);
  }
  return names;
}

std::string unknownEstimator(const std::string& name) {
  for (const EstimatorDescription& description : estimatorDescriptions()) {
    if (description.name == name) return "";
  }
  return "unknown estimator " + name + ", must be one of " + estimatorNames(", ");
}

/// The lines for the records of a stream as they are asked for, and how many records were refused.
class RecordEstimator {
 public:
  RecordEstimator(std::istream& in, std::string name) : in_(in), reader_(in), name_(std::move(name)) {}

  /// False at the end of the records. Fails if they cannot be read.
  bool next(std::string& line) {
    try {
      const std::optional<HemisphereSamples> samples = reader_.next();
      if (!samples) return false;
      line = estimateLine(name_, samples->frame, estimatorFor(*samples).estimate(*samples));
    } catch (const std::bad_alloc&) {
      line = refusal("not enough memory for these samples");
    } catch (const std::exception& error) {
      if (!in_.good() && !in_.eof()) fail(kCommand, error.what());
      line = refusal(error.what());
    }
    ++count_;
    return true;
  }

  std::size_t count() const { return count_; }
  std::size_t refusedCount() const { return refused_; }
  /// The first record refused, and why.
  const std::string& firstRefusal() const { return first_refusal_; }

 private:
  // Its tables serve all records of one shape, as files of many records have.
  const Estimator& estimatorFor(const HemisphereSamples& samples) {
    if (!estimator_ || stratification_ != samples.stratification || !(shape_ == samples.shape)) {
      estimator_ = nullptr;
      estimator_ = makeEstimator(name_, samples.stratification, samples.shape);
      stratification_ = samples.stratification;
      shape_ = samples.shape;
    }
    return *estimator_;
  }

  std::string refusal(const std::string& message) {
    if (refused_++ == 0) first_refusal_ = "record " + std::to_string(count_) + ": " + message;
    return errorLine(message);
  }

  std::istream& in_;
  SamplesReader reader_;
  std::string name_;
  std::unique_ptr<Estimator> estimator_;
  Stratification stratification_ = Stratification::kConcentric;
  GridShape shape_;
  std::size_t count_ = 0;
  std::size_t refused_ = 0;
  std::string first_refusal_;
};

void estimate(const EstimateOptions& options) {
  std::ifstream file;
  if (options.input != kStandardStream) file = openInput(options.input);
  std::istream& in = options.input == kStandardStream ? std::cin : file;
  const std::unique_ptr<WholeFile> output_file = openOutput(options.output);
  std::ostream& out = output_file ? output_file->stream() : std::cout;

  Progress progress(!output_file && isatty(STDOUT_FILENO) == 1);
  RecordEstimator estimator(in, options.estimator);
  for (std::string line; out && estimator.next(line);) {
    if (progress.isDue()) progress.show(std::to_string(estimator.count()) + " records");
    errno = 0;
    // Whoever pipes records in one at a time gets each answer at once.
    out << line << std::endl;
    if (!out && !output_file) failToWrite(kCommand, errno);
  }
  if (estimator.count() == 0) {
    fail(kCommand, (options.input == kStandardStream ? "standard input" : options.input) +
                       " is empty, must hold at least one record of samples");
  }
  if (output_file) output_file->commit();
  if (estimator.refusedCount() > 0) {
    fail(kCommand, std::to_string(estimator.refusedCount()) + " of " + std::to_string(estimator.count()) +
                       " records could not be estimated from; first " + estimator.firstRefusal());
  }
}

}  // namespace

void addEstimateCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand(kCommand, "Irradiance and its derivatives as an estimator gets them from hemisphere samples");
  const auto options = std::make_shared<EstimateOptions>();
  command->add_option("FILE", options->input, "hemisphere samples, one record after the other; - is standard input")
      ->type_name("")
      ->required();
  command->add_option("--estimator", options->estimator, "how derivatives are estimated from the samples")
      ->type_name(estimatorNames("|"))
      ->check(unknownEstimator, "")
      ->required();
  addOutputOption(*command, options->output, "where the results go, a JSON line for each record");
  command->footer(
      "Exit status: 0 if every record was estimated from, 1 if not, 2 for a wrong call. A record that is wrong has\n"
      "{\"error\": \"...\"} in place of its results.");
  command->callback([options] { estimate(*options); });
}

}  // namespace irradiff
