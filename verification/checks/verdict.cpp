#include "verification/checks/verdict.h"

#include "verification/checks/error_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

namespace irradiff {
namespace {

/// Of what stands beside "expected", "got" ...
constexpr std::size_t kIndent = 11;

std::string whereOf(const Verdict& verdict) { return "[" + verdict.check + ", " + verdict.family + "]"; }

/// Rows of a matrix below each other, so that entries can be compared by eye.
std::string byRows(const std::string& value) {
  if (!value.starts_with("[[")) {
    return value;
  }
  const std::string next = "],\n" + std::string(kIndent + 1, ' ') + "[";
  std::string text;
  std::string_view rest = value;
  for (std::size_t at = rest.find("], ["); at != std::string_view::npos; at = rest.find("], [")) {
    text += std::string(rest.substr(0, at)) + next;
    rest.remove_prefix(at + 4);
  }
  return text + std::string(rest);
}

/// The text in lines of at most 110 characters, those after the first indented by `indent`, where the first begins.
std::string wrapped(const std::string& text, std::size_t indent) {
  constexpr std::size_t kWidth = 110;
  std::istringstream words(text);
  std::string result;
  std::size_t column = indent;
  for (std::string word; words >> word;) {
    if (!result.empty() && column + 1 + word.size() > kWidth) {
      result += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (!result.empty()) {
      result += ' ';
      ++column;
    }
    result += word;
    column += word.size();
  }
  return result;
}

/// "about 7 digits are right".
std::string digitsText(double relative_error) {
  if (!(relative_error < 0.1)) {
    return "no digit is right";
  }
  const int digits = static_cast<int>(std::floor(-std::log10(relative_error)));
  return "about " + std::to_string(digits) + (digits == 1 ? " digit is right" : " digits are right");
}

std::string errorLine(const Verdict& verdict) {
  std::ostringstream text;
  text.precision(3);
  std::isnan(verdict.peak) ? text << "not a number, at worst" : text << verdict.peak << " at worst";
  if (!verdict.worst_entry.empty()) {
    text << ", in entry (" << verdict.worst_entry << ')';
  }
  // Where 1 is allowed, errors are in units of something else.
  if (verdict.tolerance < 0.5 && std::isfinite(verdict.peak) && verdict.peak > 0.0) {
    text << ", " << digitsText(verdict.peak);
  }
  if (std::isfinite(verdict.rms)) {
    text << "; rms " << verdict.rms;
  }
  text << "; allowed " << verdict.tolerance << " (" << verdict.rule << ')';
  if (verdict.uncertainty > 0.0) {
    text << ", above the check's own " << verdict.uncertainty;
  }
  return text.str();
}

std::string causeLine(const Verdict& verdict) {
  if (verdict.likely_cause.empty()) {
    return "nothing that is usually wrong looks like this";
  }
  if (verdict.inputs_of_cause == verdict.wrong_inputs || verdict.inputs_of_cause == 0) {
    return verdict.likely_cause;
  }
  return verdict.likely_cause + " (so it looks on " + std::to_string(verdict.inputs_of_cause) + " of " +
         std::to_string(verdict.wrong_inputs) + " wrong inputs)";
}

std::string outcomeOf(const Verdict& verdict) {
  if (verdict.inputs == 0) {
    return "WRONG, for want of inputs";
  }
  return "WRONG on " + std::to_string(verdict.wrong_inputs) + " of " + std::to_string(verdict.inputs) +
         (verdict.inputs == 1 ? " input" : " inputs");
}

std::string inputsText(std::size_t inputs) { return std::to_string(inputs) + (inputs == 1 ? " input" : " inputs"); }

bool isNotFinite(const Verdict& verdict) { return verdict.likely_cause == kNotFiniteText; }

/// "rotation, 3 closed forms, mirror": the checks of the verdicts, each once.
std::string checkList(const std::vector<const Verdict*>& verdicts) {
  constexpr std::string_view kClosedForm = "closed form ";
  const auto isClosedForm = [kClosedForm](const std::string& check) { return check.starts_with(kClosedForm); };
  std::vector<std::string> names;
  for (const Verdict* verdict : verdicts) {
    if (std::ranges::find(names, verdict->check) == names.end()) {
      names.push_back(verdict->check);
    }
  }
  const auto closed_forms = std::ranges::count_if(names, isClosedForm);
  std::string text;
  bool are_counted = closed_forms < 2;
  for (const std::string& name : names) {
    if (closed_forms > 1 && isClosedForm(name)) {
      text += are_counted ? "" : (text.empty() ? "" : ", ") + std::to_string(closed_forms) + " closed forms";
      are_counted = true;
    } else {
      text += (text.empty() ? "" : ", ") + name;
    }
  }
  return text;
}

}  // namespace

std::string describe(const Verdict& verdict) {
  const std::string head = verdict.candidate + ": " + nameOf(verdict.quantity) + ": ";
  if (verdict.passed) {
    return head + "ok on " + inputsText(verdict.inputs) + ' ' + whereOf(verdict) + ": " + errorLine(verdict);
  }
  std::string text = head + outcomeOf(verdict) + ' ' + whereOf(verdict);
  if (verdict.inputs == 0) {
    return text;
  }
  text += "\n  expected " + byRows(verdict.expected);
  text += "\n  got      " + byRows(verdict.actual);
  text += "\n  error    " + wrapped(errorLine(verdict), kIndent);
  text += "\n  likely   " + wrapped(causeLine(verdict), kIndent);
  text += "\n  where    " + verdict.worst_input_in_words;
  text += "\n  repeat   echo '" + verdict.worst_input + "' | ./run evaluate -";
  return text;
}

std::string summarize(const std::vector<Verdict>& verdicts) {
  std::vector<const Verdict*> failed;
  std::vector<const Verdict*> passed;
  for (const Verdict& verdict : verdicts) {
    (verdict.passed ? passed : failed).push_back(&verdict);
  }
  const std::string name = verdicts.empty() ? "nothing" : verdicts.front().candidate;
  std::string text = name + ": " + (failed.empty() ? "all " : std::to_string(failed.size()) + " of ") +
                     std::to_string(verdicts.size()) + (failed.empty() ? " checks passed" : " checks failed") + '\n';
  // What twenty checks find is often one mistake: told once for each quantity, by the check that recognises it, or else
  // by one that knows the right value.
  std::set<Quantity> told;
  std::set<std::pair<Quantity, std::string>> told_causes;
  const auto tellFirst = [&](const auto& is_telling) {
    for (const Verdict* first : failed) {
      if (!is_telling(*first) || !told.insert(first->quantity).second) {
        continue;
      }
      told_causes.emplace(first->quantity, first->likely_cause);
      text += '\n' + describe(*first) + '\n';
      std::vector<const Verdict*> same;
      std::ranges::copy_if(failed, std::back_inserter(same), [&](const Verdict* other) {
        return other != first && other->quantity == first->quantity && other->likely_cause == first->likely_cause;
      });
      if (!same.empty()) {
        text += "  likewise " + wrapped(checkList(same), kIndent) + '\n';
      }
    }
  };
  tellFirst([](const Verdict& verdict) { return verdict.inputs_of_cause > 0 && !isNotFinite(verdict); });
  tellFirst([](const Verdict& verdict) { return verdict.likely_cause.empty(); });
  tellFirst([](const Verdict&) { return true; });
  std::string lines;
  for (const Verdict* verdict : failed) {
    if (told_causes.contains({verdict->quantity, verdict->likely_cause})) {
      continue;
    }
    std::string line = verdict->check + ", " + nameOf(verdict->quantity) + ": " + outcomeOf(*verdict);
    if (isNotFinite(*verdict)) {
      line += ", not finite";
    } else if (!verdict->likely_cause.empty()) {
      line += (verdict->inputs_of_cause > 0 ? "; likely " : "; usually ") + verdict->likely_cause;
    }
    lines += wrapped(line, 8) + '\n';
  }
  text += lines.empty() ? "" : "\nalso failed:\n" + lines;
  if (!passed.empty()) {
    text += "\npassed: " + wrapped(checkList(passed), 8) + '\n';
  }
  return text;
}

std::vector<Verdict> failures(const std::vector<Verdict>& verdicts) {
  std::vector<Verdict> failed;
  std::ranges::copy_if(verdicts, std::back_inserter(failed), [](const Verdict& verdict) { return !verdict.passed; });
  return failed;
}

}  // namespace irradiff
