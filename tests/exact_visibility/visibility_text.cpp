#include "tests/exact_visibility/visibility_text.h"

namespace irradiff {

namespace {

std::string textOf(const ExactArcLimit& limit) {
  std::string text = limit.t ? textOf(*limit.t) : textOf(limit.point);
  if (limit.kind == ExactLimitKind::kHorizon) text += " horizon";
  if (limit.kind == ExactLimitKind::kCrossing) text += " at";
  if (limit.kind == ExactLimitKind::kEndpoint && !limit.crossing.empty()) text += " on";
  for (const ExactLine& line : limit.crossing) text += ' ' + textOf(line);
  return text;
}

std::string textOf(const FrontPolygon& polygon) { return polygon ? std::to_string(*polygon) : "-"; }

}  // namespace

std::string textOf(const ExactRational& number) {
  return number.denominator == "1" ? number.numerator : number.numerator + '/' + number.denominator;
}

std::string textOf(const ExactVector& vector) {
  return '(' + textOf(vector[0]) + ", " + textOf(vector[1]) + ", " + textOf(vector[2]) + ')';
}

std::string textOf(const ExactLine& line) {
  return std::to_string(line.polygon) + (line.kind == ExactLine::Kind::kEdge ? '.' : 'x') +
         std::to_string(line.edge_or_partner);
}

std::string textOf(const ExactArc& arc) {
  std::string text = textOf(arc.line) + " [" + textOf(arc.begin) + ", " + textOf(arc.end) + "] left " +
                     textOf(arc.left) + " right " + textOf(arc.right);
  if (!arc.aligned.empty()) text += " aligned";
  for (const ExactLine& line : arc.aligned) text += ' ' + textOf(line);
  return text;
}

std::string textOf(const ExactApparentVertex& vertex) {
  std::string text = textOf(vertex.direction);
  for (const ExactLine& line : vertex.lines) text += ' ' + textOf(line);
  return vertex.degenerate ? text + " degenerate" : text;
}

std::string textOf(const ExactHorizonArc& arc) {
  return textOf(arc.begin) + " to " + textOf(arc.end) + " polygon " + std::to_string(arc.polygon);
}

}  // namespace irradiff
