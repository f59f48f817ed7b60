#include "experiments/cli/inspection_text.h"

#include "experiments/cli/evaluation_text.h"
#include "experiments/cli/json_values.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace irradiff {
namespace {

constexpr std::size_t kLabelWidth = 38;

std::string brief(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

std::string labelled(const std::string& label, const std::string& text) {
  std::string line = "  " + label;
  line.resize(std::max(line.size() + 2, kLabelWidth), ' ');
  return line + text + '\n';
}

/// A paragraph in lines of at most 118 characters, but for longer words.
std::string wrapped(const std::string& paragraph) {
  constexpr std::size_t kLineLength = 118;
  std::istringstream words(paragraph);
  std::string text, line, word;
  while (words >> word) {
    if (!line.empty() && line.size() + 1 + word.size() > kLineLength) {
      text += line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return text + line + '\n';
}

/// "3", or "1 to 5, median 3".
std::string rangeText(const ValueRange& range, const std::string& unit = "") {
  if (range.isEmpty()) return "-";
  if (range.least() == range.largest()) return brief(range.least()) + unit;
  return brief(range.least()) + " to " + brief(range.largest()) + unit + ", median " + brief(range.median()) + unit;
}

std::string counted(std::size_t count, const char* thing) {
  return std::to_string(count) + ' ' + thing + (count == 1 ? "" : "s");
}

std::string shareText(std::size_t count, std::size_t all) {
  if (count == 0) return "no";
  return count == all ? "yes" : "at " + std::to_string(count) + " of " + std::to_string(all);
}

std::string rangeJson(const ValueRange& range, bool with_sum = false) {
  if (range.isEmpty()) return "null";
  return "{\"least\":" + jsonNumber(range.least(), "least") + ",\"median\":" + jsonNumber(range.median(), "median") +
         ",\"largest\":" + jsonNumber(range.largest(), "largest") +
         (with_sum ? ",\"sum\":" + jsonNumber(range.sum(), "sum") : "") + "}";
}

template <int Dimension>
std::string eventJson(const std::optional<VisibilityEvent<Dimension>>& event) {
  if (!event) return "null";
  return std::string("{\"kind\":\"") + nameOf(event->kind) +
         "\",\"distance\":" + jsonNumber(event->distance, "distance") +
         ",\"rounding\":" + jsonNumber(event->rounding, "rounding") + ",\"what\":" + jsonString(event->what) + "}";
}

std::string finiteOrNull(double value, const char* field) {
  return std::isfinite(value) ? jsonNumber(value, field) : "null";
}

}  // namespace

std::string inspectionText(const SceneInspection& s) {
  const bool is_flat = s.dimension == 2;
  std::string text =
      counted(s.sources, is_flat ? "segment" : "polygon") + ", " + counted(s.receivers, "receiver") + '\n';
  if (!s.description.empty()) text += wrapped(s.description);
  text += "\nwhat it needs\n";
  text += labelled("occlusion", shareText(s.with_occlusion, s.receivers));
  text += labelled("cuts at the horizon", shareText(s.with_horizon, s.receivers));
  if (!is_flat) {
    text +=
        labelled("apparent vertices", shareText(s.with_apparent_vertices, s.receivers) +
                                          (s.with_apparent_vertices > 0 ? ": " + rangeText(s.apparent_vertices) : ""));
  }
  text += labelled("precision for " + brief(s.tolerance), [&] {
    std::string rungs;
    for (const Rung rung : kRungs) {
      const std::size_t count = s.rungs[static_cast<std::size_t>(rung)];
      if (count == 0) continue;
      rungs += (rungs.empty() ? "" : ", ") + std::string(nameOf(rung));
      if (count < s.receivers) rungs += " at " + std::to_string(count);
    }
    return rungs + " (bounds in double: " + rangeText(s.relative_bounds) + ")";
  }());
  if (!s.costs.isEmpty()) {
    text += labelled("estimated cost", rangeText(s.costs) + " unhidden squares a receiver" +
                                           (s.receivers > 1 ? ", " + brief(s.costs.sum()) + " in all" : ""));
  }
  text += is_flat ? "\nwhat becomes of the segments, at each receiver\n"
                  : "\nwhat becomes of the polygons, at each receiver\n";
  for (std::size_t i = 0; i < kTreatments.size(); ++i) {
    const ValueRange& range = s.treatments[i];
    if (!range.isEmpty() && range.largest() > 0.0) text += labelled(kTreatments[i].text, rangeText(range));
  }
  text += "\nwhat its Hessians are good for\n";
  text += labelled("nearest visibility event", rangeText(s.event_distances, " m"));
  text += labelled("nearest at which a Hessian jumps", rangeText(s.jump_distances, " m"));
  text += labelled("range for 1 % of irradiance", rangeText(s.promised_ranges, " m"));
  std::string uses;
  for (const HessianUse use : kHessianUses) {
    const std::size_t count = s.hessians[static_cast<std::size_t>(use)];
    if (count > 0) uses += (uses.empty() ? "" : ", ") + std::string(nameOf(use)) + " at " + std::to_string(count);
  }
  text += labelled("Hessians", uses);
  if (!s.groups.empty()) text += "\nreceivers to look at\n";
  for (const NotedGroup& group : s.groups) {
    text += "  " + group.title + ": " + counted(group.count, "receiver") + '\n';
    std::size_t named = 0;
    for (const NotedPoint& point : group.worst) {
      text += "    " + point.name + " " + point.position +
              (point.count > 1 ? " and " + std::to_string(point.count - 1) + " others" : "") + ": " + point.text + '\n';
      named += point.count;
    }
    if (group.count > named) text += "    and " + std::to_string(group.count - named) + " more\n";
  }
  return text;
}

std::string inspectionJson(const SceneInspection& s) {
  std::string text =
      "{\"dimension\":" + std::to_string(s.dimension) + ",\"tolerance\":" + jsonNumber(s.tolerance, "tolerance") +
      (s.dimension == 2 ? ",\"segments\":" : ",\"polygons\":") + std::to_string(s.sources) +
      ",\"receivers\":" + std::to_string(s.receivers) + ",\"occlusion\":" + std::to_string(s.with_occlusion) +
      ",\"horizon\":" + std::to_string(s.with_horizon) + ",\"apparent_vertices\":" + rangeJson(s.apparent_vertices) +
      ",\"treatments\":{";
  for (std::size_t i = 0; i < kTreatments.size(); ++i) {
    text += (i > 0 ? ",\"" : "\"") + std::string(kTreatments[i].field) + "\":" + rangeJson(s.treatments[i]);
  }
  text += "},\"precision\":{";
  for (const Rung rung : kRungs) {
    text += (rung == Rung::kDouble ? "\"" : ",\"") + std::string(nameOf(rung)) +
            "\":" + std::to_string(s.rungs[static_cast<std::size_t>(rung)]);
  }
  text += "},\"relative_bound\":" + rangeJson(s.relative_bounds) + ",\"hessian\":{";
  for (const HessianUse use : kHessianUses) {
    text += (use == HessianUse::kMissing ? "\"" : ",\"") + std::string(nameOf(use)) +
            "\":" + std::to_string(s.hessians[static_cast<std::size_t>(use)]);
  }
  text += "},\"event_distance\":" + rangeJson(s.event_distances) + ",\"jump_distance\":" + rangeJson(s.jump_distances) +
          ",\"promised_range\":" + rangeJson(s.promised_ranges) + ",\"cost\":" + rangeJson(s.costs, true) +
          ",\"to_look_at\":[";
  for (std::size_t i = 0; i < s.groups.size(); ++i) {
    const NotedGroup& group = s.groups[i];
    text += (i > 0 ? "," : "") + std::string("{\"title\":") + jsonString(group.title) +
            ",\"count\":" + std::to_string(group.count) + ",\"worst\":[";
    for (std::size_t k = 0; k < group.worst.size(); ++k) {
      const NotedPoint& point = group.worst[k];
      text += (k > 0 ? "," : "") + std::string("{\"receiver\":") + std::to_string(point.index) +
              ",\"count\":" + std::to_string(point.count) + ",\"name\":" + jsonString(point.name) +
              ",\"position\":" + point.position + ",\"text\":" + jsonString(point.text) + "}";
    }
    text += "]}";
  }
  return text + "]}";
}

template <int Dimension>
std::string pointJson(std::size_t index, const PointInspection<Dimension>& point) {
  return "{\"receiver\":" + std::to_string(index) +
         ",\"position\":" + jsonVector<Dimension>(point.receiver.position, "position") +
         ",\"model\":" + modelText(point.evaluation, nameOf(Rung::kDouble)) + ",\"precision\":{\"expected\":\"" +
         nameOf(point.rung) + "\",\"relative_bound\":" + finiteOrNull(point.loosest_bound.relative, "relative_bound") +
         ",\"quantity\":" + jsonString(point.loosest_bound.quantity) + "},\"event\":" + eventJson(point.event) +
         ",\"jump\":" + eventJson(point.jump) +
         (point.changes_within ? ",\"changes_within\":" + jsonNumber(*point.changes_within, "changes_within") : "") +
         ",\"hessian\":\"" + nameOf(point.hessian) +
         "\",\"promised_range\":" + finiteOrNull(point.promised_range, "promised_range") +
         (point.cost ? ",\"cost\":" + jsonNumber(*point.cost, "cost") : "") + "}";
}

template std::string pointJson(std::size_t, const PointInspection<3>&);
template std::string pointJson(std::size_t, const PointInspection<2>&);

}  // namespace irradiff
