#include "experiments/cli/check_command.h"

#include "derivatives/form_factor/polygon_evaluation.h"
#include "experiments/cli/bounded_number.h"
#include "experiments/cli/command_files.h"
#include "experiments/cli/outside_program.h"
#include "experiments/cli/whole_number.h"
#include "verification/checks/input_families.h"
#include "verification/checks/suite.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <iostream>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

namespace irradiff {
namespace {

using nlohmann::json;

constexpr const char* kCommand = "check";

struct CheckOptions {
  std::string program;
  SuiteOptions suite{.inputs = 30, .tolerance = 1e-12};
};

const char* fieldOf(Quantity quantity) {
  switch (quantity) {
    case Quantity::kFormFactor:
    case Quantity::kIrradiance:
      return "irradiance";
    case Quantity::kGradient:
      return "gradient";
    case Quantity::kHessian:
      return "hessian";
    case Quantity::kTangentialHessian:
      return "tangential_hessian";
    case Quantity::kRotationalGradient:
      return "rotational_gradient";
  }
  return "";
}

/// A number, an array of numbers or one of rows. Throws std::runtime_error naming the field unless it has that shape.
Eigen::MatrixXd numbersOf(const json& value, const char* field, Eigen::Index rows, Eigen::Index columns) {
  const auto refuse = [&]() -> double {
    throw std::runtime_error(std::string("\"") + field + "\" is " + value.dump() + ", must be " +
                             (rows == 1 ? "a number" : std::to_string(rows) + (columns == 1 ? " numbers" : " rows")));
  };
  const auto number = [&](const json& entry) { return entry.is_number() ? entry.get<double>() : refuse(); };
  const auto row = [&](const json& entry, std::size_t size) -> const json& {
    if (!entry.is_array() || entry.size() != size) refuse();
    return entry;
  };
  Eigen::MatrixXd result(rows, columns);
  if (rows == 1) {
    result(0, 0) = number(value);
    return result;
  }
  row(value, static_cast<std::size_t>(rows));
  for (Eigen::Index i = 0; i < rows; ++i) {
    const json& entries = value[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < columns; ++j) {
      result(i, j) =
          number(columns == 1 ? entries : row(entries, static_cast<std::size_t>(columns))[static_cast<std::size_t>(j)]);
    }
  }
  return result;
}

/// The program's results for one scene. Throws std::runtime_error with the error that it gives, or for what is no
/// result.
json resultOf(const std::string& answer) {
  const json line = json::parse(answer, nullptr, false);
  if (line.is_object() && line.contains("error")) throw std::runtime_error(line["error"].dump());
  const bool has_result = line.is_object() && line.contains("results") && line["results"].is_array() &&
                          line["results"].size() == 1 && line["results"][0].is_object();
  if (!has_result) {
    throw std::runtime_error("the program answers " + answer.substr(0, 200) +
                             R"(, must answer a line {"results": [{"gradient": [x,y,z], ...}]})");
  }
  return line["results"][0];
}

/// The answers of a program, each asked for once.
class Answers {
 public:
  explicit Answers(const std::string& command) : program_(command) {}

  const json& of(const Configuration& configuration) {
    const std::string line = sceneLine(configuration);
    if (const auto known = answers_.find(line); known != answers_.end()) return known->second;
    return answers_.emplace(line, resultOf(program_.answer(line))).first->second;
  }
  const std::string& failure() const { return program_.failure(); }

 private:
  OutsideProgram program_;
  std::map<std::string, json> answers_;
};

/// A candidate of what the program answers to a first scene. Its irradiance is positive from either side: the order of
/// the vertices gives the form factor its sign.
Candidate candidateOf(Answers& answers) {
  const auto value = [&answers](Quantity quantity, Eigen::Index rows, Eigen::Index columns) {
    return [&answers, quantity, rows, columns](const Configuration& c) -> Eigen::MatrixXd {
      const json& result = answers.of(c);
      const char* field = fieldOf(quantity);
      if (!result.contains(field)) throw std::runtime_error(std::string("\"") + field + "\" is missing");
      const double sign = evaluatePolygon(c.polygon, 0, c.receiver).is_clockwise ? 1.0 : -1.0;
      return sign * std::numbers::inv_pi * numbersOf(result[field], field, rows, columns);
    };
  };
  const json& first = answers.of(drawInputs(inputFamily("well-conditioned"), 1, 1).front());
  const auto has = [&first](Quantity quantity) {
    const auto field = first.find(fieldOf(quantity));
    return field != first.end() && !field->is_null();
  };
  Candidate candidate{"the program"};
  if (has(Quantity::kFormFactor)) {
    candidate.form_factor = [f = value(Quantity::kFormFactor, 1, 1)](const Configuration& c) { return f(c)(0, 0); };
  }
  if (has(Quantity::kGradient)) candidate.gradient = value(Quantity::kGradient, 3, 1);
  if (has(Quantity::kHessian)) candidate.hessian = value(Quantity::kHessian, 3, 3);
  if (has(Quantity::kTangentialHessian)) candidate.tangential_hessian = value(Quantity::kTangentialHessian, 2, 2);
  if (has(Quantity::kRotationalGradient)) candidate.rotational_gradient = value(Quantity::kRotationalGradient, 3, 1);
  return candidate;
}

void check(const CheckOptions& options) {
  std::vector<Verdict> verdicts;
  try {
    Answers answers(options.program);
    const Candidate candidate = candidateOf(answers);
    verdicts = checkAll(candidate, options.suite);
    if (!answers.failure().empty()) fail(kCommand, answers.failure());
  } catch (const CLI::Error&) {
    throw;
  } catch (const std::exception& error) {
    fail(kCommand, error.what());
  }
  if (verdicts.empty()) fail(kCommand, "the program answers none of the quantities, so nothing can be checked");
  std::cout << summarize(verdicts) << std::flush;
  if (!failures(verdicts).empty()) throw CLI::RuntimeError(1);
}

}  // namespace

void addCheckCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(kCommand, "Checks a program of your own, in any language, by all oracles");
  const auto options = std::make_shared<CheckOptions>();
  command
      ->add_option("COMMAND", options->program,
                   "what the shell starts; it reads scenes of one polygon and one receiver, a line each, and answers "
                   "each with a line as irradiff evaluate does, at once; what it leaves out is not checked")
      ->required()
      ->type_name("");
  command->add_option("--inputs", options->suite.inputs, "random inputs of each check, up to 100000")
      ->check(wholeNumber(1, 100000))
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--seed", options->suite.seed, "seed of all random inputs")
      ->check(wholeNumber(0, kLargestSeed))
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--tolerance", options->suite.tolerance, "relative error allowed, from 1e-16 to 1")
      ->check(boundedNumber(1e-16, 1.0))
      ->type_name("T")
      ->capture_default_str();
  command->add_flag("--horizon", options->suite.knows_horizon, "polygons that cross the horizon too");
  command->footer("Exit status: 0 if every check passed, 1 if not, 2 for a wrong call.");
  command->callback([options] { check(*options); });
}

}  // namespace irradiff
