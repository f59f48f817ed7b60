#include "experiments/pareto/pareto_page.h"

#include "experiments/figures/estimate_errors.h"
#include "verification/report/html.h"
#include "verification/report/page_sections.h"
#include "verification/report/page_style.h"

#include <algorithm>
#include <cstdio>

namespace irradiff {

namespace {

/// What the chooser's regret is asked to be at most, on every family.
constexpr double kAskedRegret = 1.3;

std::string toleranceText(double tolerance) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0e", tolerance);
  return text;
}

std::string whole(double value) { return std::to_string(static_cast<long>(value + 0.5)); }

std::string frontTable(const FamilyTrade& family) {
  HtmlTable table({"on the front, fastest first", "ns for a polygon", "times the appendix form", "median error",
                   "99 % error", "largest error", "compared"});
  std::vector<const MethodTrade*> front;
  for (const MethodTrade& method : family.methods) {
    if (method.on_front) front.push_back(&method);
  }
  std::ranges::stable_sort(front, {}, [](const MethodTrade* method) { return method->nanoseconds.median; });
  for (const MethodTrade* method : front) {
    const ErrorStatistics& errors = method->errors[kLargestError];
    table.add({escaped(method->method), spreadText(method->nanoseconds, 3), spreadText(method->ratio, 3),
               errorNumber(errors.median), errorNumber(errors.percentile99), errorNumber(errors.peak),
               std::to_string(method->compared) + " of " + std::to_string(family.inputs)});
  }
  return element("h3", escaped(family.family)) + element("p", escaped(family.description), "class=\"soft\"") +
         table.html();
}

std::string regretSection(const Pareto& pareto) {
  HtmlTable table({"family", "tolerance", "regret", "ns chosen", "ns best in hindsight", "ns without a tolerance",
                   "regret beside all formulas", "guaranteed", "fell back"});
  for (const RuleRegret& row : pareto.regrets) {
    if (row.in_set.inputs == 0) {
      table.add({escaped(row.family), toleranceText(row.tolerance), "-", "-", "-", "-", "-",
                 "0 of " + std::to_string(row.inputs), "-"});
      continue;
    }
    const bool is_within = row.in_set.regret.median <= kAskedRegret;
    table.add({escaped(row.family), toleranceText(row.tolerance),
               spreadText(row.in_set.regret, 3) + (is_within ? "" : ' ' + badge("above 1.3", "none")),
               whole(row.in_set.chosen), whole(row.in_set.best), whole(row.without_tolerance),
               spreadText(row.of_all.regret, 3), std::to_string(row.guaranteed) + " of " + std::to_string(row.inputs),
               std::to_string(row.fell_back)});
  }
  return element("h2", "What choosing costs", "id=\"regret\"") +
         element("p",
                 "evaluatePolygon with a tolerance, choosing and checking its bounds included, beside the fastest rule "
                 "of its own set that meets the tolerance in hindsight, judged input by input by its true error: "
                 "median (smallest .. largest) over the rounds. Inputs count where some rule's bounds meet the "
                 "tolerance. Formulas, which have no bounds, and F, gradient and Hessian alone, are beside it in the "
                 "last regret; they compete where the polygon is above the horizon. Fell back: to evaluatePolygon "
                 "without a tolerance.") +
         table.html();
}

std::string estimatorSection(const Pareto& pareto) {
  HtmlTable table({"on the front, fastest first", "quantity", "rays", "microseconds for a receiver",
                   "of it the estimator", "median error", "99 % error", "largest error"});
  std::vector<const EstimatorTrade*> front;
  for (const EstimatorTrade& trade : pareto.estimators) {
    if (trade.on_front) front.push_back(&trade);
  }
  std::ranges::stable_sort(front, [](const EstimatorTrade* a, const EstimatorTrade* b) {
    return std::pair(a->compared, a->microseconds.median) < std::pair(b->compared, b->microseconds.median);
  });
  for (const EstimatorTrade* trade : front) {
    table.add({escaped(trade->estimator.label()), quantityOf(trade->compared).name, std::to_string(trade->rays),
               spreadText(trade->microseconds, 3), whole(100.0 * trade->estimate_share.median) + " %",
               errorNumber(trade->errors.median), errorNumber(trade->errors.percentile99),
               errorNumber(trade->errors.peak)});
  }
  return element("h2", "Estimators on Figure 5", "id=\"estimators\"") +
         element("p",
                 "Directions, rays and estimate on one thread; relative errors of the gradient along the plane "
                 "and of the tangential Hessian over " +
                     std::to_string(pareto.plan.estimators.receivers) + " receivers.") +
         table.html();
}

}  // namespace

std::vector<std::string> paretoSentences(const Pareto& pareto) {
  std::vector<std::string> sentences;
  std::size_t within = 0;
  std::size_t all = 0;
  const RuleRegret* worst = nullptr;
  for (const RuleRegret& row : pareto.regrets) {
    if (row.in_set.inputs == 0) continue;
    ++all;
    within += row.in_set.regret.median <= kAskedRegret ? 1 : 0;
    if (worst == nullptr || row.in_set.regret.median > worst->in_set.regret.median) worst = &row;
  }
  if (worst != nullptr) {
    sentences.push_back("The regret of choosing a rule is at most 1.3 in " + std::to_string(within) + " of " +
                        std::to_string(all) + " combinations of family and tolerance; the largest is " +
                        spreadText(worst->in_set.regret, 3) + ", on " + worst->family + " at " +
                        toleranceText(worst->tolerance) + ".");
  }
  for (const double tolerance : kChoiceTolerances) {
    std::vector<double> gains;
    std::size_t broken = 0;
    std::size_t missed = 0;
    for (const RuleRegret& row : pareto.regrets) {
      if (row.tolerance != tolerance || row.in_set.inputs == 0) continue;
      gains.push_back(row.without_tolerance / row.in_set.chosen);
      broken += row.broken;
      missed += row.missed;
    }
    if (gains.empty()) continue;
    sentences.push_back("To " + toleranceText(tolerance) + " evaluatePolygon is " + spreadText(spreadOf(gains), 2) +
                        " times as fast as without a tolerance, median (smallest .. largest) over the families" +
                        (broken == 0 ? "; it kept the tolerance on every input where it said so"
                                     : "; WRONG: it broke its word on " + std::to_string(broken) + " inputs") +
                        (missed == 0 ? "."
                                     : ", and gave up on " + std::to_string(missed) +
                                           " where one of its rules is guaranteed to meet it."));
  }
  return sentences;
}

std::string paretoPage(const Pareto& pareto, const RunRecord& record, const std::string& svg) {
  std::string sentences;
  for (const std::string& sentence : paretoSentences(pareto)) sentences += element("li", escaped(sentence));
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += element("title", "irradiff: speed against accuracy") + '\n' + element("style", kPageStyle) +
          "\n</head>\n<body>\n" + element("h1", "Speed against accuracy") + '\n' + element("ul", sentences) + '\n';
  page +=
      element("p",
              escaped(record.machine) + "; " + escaped(record.compiler) + "; " + std::to_string(pareto.plan.inputs) +
                  " inputs of each family, seed " + std::to_string(pareto.plan.seed) +
                  ", one thread. Times are medians (smallest .. largest) over " + std::to_string(pareto.plan.rounds) +
                  " rounds in which all take turns. Errors are against 200 "
                  "digits: of F, gradient and Hessian the largest, each max|difference|/max|truth|.",
              "class=\"soft\"") +
      '\n';
  page += element("div", inlineSvg(svg, "trade-", "Error against time of every method, with the Pareto front"),
                  "class=\"scroll\"") +
          '\n';
  page += regretSection(pareto) + estimatorSection(pareto);
  page += element("h2", "Fronts", "id=\"fronts\"") +
          element("p",
                  "Formulas that do not cut at the horizon are compared on the polygons that are above it, and timed "
                  "on all. The whole tables are in trade.csv, errors.csv, regret.csv and estimators.csv.");
  for (const FamilyTrade& family : pareto.families) page += frontTable(family);
  return page + "</body>\n</html>\n";
}

}  // namespace irradiff
