#include "experiments/figures/estimator_section.h"

#include "experiments/figures/convergence_plots.h"
#include "verification/report/html.h"
#include "verification/report/page_sections.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace irradiff {
namespace {

const char* wordFor(Compared compared) { return compared == Compared::kGradient ? "gradient" : "tangential Hessian"; }

const std::optional<ErrorSummary>& errorsOf(const EstimatorErrors& row, Compared compared) {
  return compared == Compared::kGradient ? row.gradient : row.hessian;
}

/// Median, 99 % and RMS; a dash where the estimator does not know the quantity.
std::string errorCell(const std::optional<ErrorSummary>& errors) {
  if (!errors) return "-";
  return errorNumber(errors->median) + ", " + errorNumber(errors->percentile99) + ", " + errorNumber(errors->rms);
}

/// "0.25 W/m³, 5.6 W/m⁴": what the estimator knows of gradient and Hessian.
std::string leakText(const ConstantRadianceLeak& leak) {
  std::string text;
  if (leak.gradient) text = errorNumber(*leak.gradient) + " W/m³";
  if (leak.hessian) text += (text.empty() ? "" : ", ") + errorNumber(*leak.hessian) + " W/m⁴";
  return text;
}

std::string orderCell(const ConvergenceCurve* curve) {
  if (curve == nullptr || std::isnan(curve->order.median)) return "-";
  return errorNumber(curve->order.median) + " (" + errorNumber(curve->order.low) + " .. " +
         errorNumber(curve->order.high) + ')';
}

/// "a", "a and b", "a, b and c".
std::string listText(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  }
  return text;
}

std::string rankingSentence(const EstimatorComparison::InScene& in, Compared compared) {
  std::vector<const EstimatorErrors*> ranked;
  for (const EstimatorErrors& row : in.errors) {
    const auto& errors = errorsOf(row, compared);
    if (errors && errors->compared > 0) ranked.push_back(&row);
  }
  if (ranked.size() < 2) return "";
  std::ranges::stable_sort(ranked, {}, [&](const EstimatorErrors* row) { return errorsOf(*row, compared)->median; });
  const auto text = [&](const EstimatorErrors& row) {
    const ErrorSummary& errors = *errorsOf(row, compared);
    return row.estimator.label() + " (" + errorNumber(errors.median) + "; 99 % of the receivers have at most " +
           errorNumber(errors.percentile99) + ")";
  };
  return "In " + in.scene.name + " the least median error of the " + wordFor(compared) + " is that of " +
         text(*ranked[0]) + ", the next that of " + text(*ranked[1]) + '.';
}

void addClosureSentences(const EstimatorComparison& comparison, std::vector<std::string>& sentences) {
  std::vector<std::string> closed;
  std::vector<std::string> open;
  std::vector<std::string> broken;
  for (const ConstantRadianceLeak& leak : comparison.leaks) {
    const bool is_closed = isClosed(leak, comparison.plan);
    (is_closed ? closed : open)
        .push_back(is_closed ? leak.estimator.label() : leak.estimator.label() + " (" + leakText(leak) + ')');
    if (leak.claims_zero && !is_closed) broken.push_back(leak.estimator.label());
  }
  if (!closed.empty()) {
    sentences.push_back("Constant radiance gives derivatives of 0, to rounding (at most " +
                        errorNumber(leakOfRounding(comparison.plan)) + "), with " + listText(closed) + '.');
  }
  if (!open.empty()) sentences.push_back("It does not with " + listText(open) + '.');
  sentences.push_back(broken.empty() ? "Every estimator that claims to give 0 does."
                                     : "WRONG: " + listText(broken) + " claims to give 0.");
}

std::string sceneTable(const EstimatorComparison& comparison, const EstimatorComparison::InScene& in,
                       std::span<const QualityFigure::Curves> curves) {
  HtmlTable table({"estimator", "rays", "gradient: median, 99 %, RMS", "order of the gradient",
                   "Hessian: median, 99 %, RMS", "order of the Hessian", "constant radiance gives"});
  for (std::size_t i = 0; i < in.errors.size(); ++i) {
    const EstimatorErrors& row = in.errors[i];
    const ConstantRadianceLeak& leak = comparison.leaks.at(i);
    std::string constant = leakText(leak);
    if (leak.claims_zero) {
      const bool is_right = isClosed(leak, comparison.plan);
      constant += ' ' + badge(is_right ? "0, as claimed" : "WRONG: claims 0", is_right ? "right" : "wrong");
    }
    table.add({escaped(row.estimator.label()), std::to_string(row.rays), errorCell(row.gradient),
               orderCell(findCurve(curves, in.scene.name, row.estimator, Compared::kGradient)), errorCell(row.hessian),
               orderCell(findCurve(curves, in.scene.name, row.estimator, Compared::kHessian)), constant});
  }
  std::size_t compared = 0;
  for (const EstimatorErrors& row : in.errors) {
    if (row.gradient) compared = std::max(compared, row.gradient->compared);
  }
  return element("h3", escaped(in.scene.name)) + '\n' + table.html() +
         element("p",
                 "Over " + std::to_string(compared) + " of " + std::to_string(in.grid.width) + " x " +
                     std::to_string(in.grid.height) +
                     " receivers, those where the gradient exists and is not 0 to within its error bound.",
                 "class=\"soft\"") +
         '\n';
}

std::string orderText(std::span<const QualityFigure::Curves> curves) {
  if (curves.empty() || curves[0].curves.empty()) return "";
  const std::vector<ConvergencePoint>& points = curves[0].curves[0].points;
  const std::size_t seeds = std::ranges::min(points, {}, [](const auto& p) { return p.medians.size(); }).medians.size();
  return " The order is p in an error that falls like 1/N^p with N x N rays, fitted to the median errors from " +
         std::to_string(kFirstRaysOfOrder) + " rays on; in brackets the range of 90 % of " + std::to_string(seeds) +
         " seeds. Where an estimator begins to work between two numbers of rays, p measures that fall and is no power "
         "law.";
}

}  // namespace

std::vector<std::string> comparisonSentences(const EstimatorComparison& comparison) {
  std::vector<std::string> sentences;
  for (const EstimatorComparison::InScene& in : comparison.scenes) {
    for (const Compared compared : {Compared::kGradient, Compared::kHessian}) {
      const std::string sentence = rankingSentence(in, compared);
      if (!sentence.empty()) sentences.push_back(sentence);
    }
    if (in.gap_share) {
      sentences.push_back("In " + in.scene.name + " filled gaps alone, without any noise, cost " +
                          errorNumber(100.0 * *in.gap_share) +
                          " % of the receivers more than a tenth of the Hessian in space: meshes over samples fill "
                          "them.");
    }
  }
  addClosureSentences(comparison, sentences);
  return sentences;
}

FurtherSection estimatorSection(const EstimatorComparison& comparison, std::span<const QualityFigure::Curves> curves) {
  std::string html =
      element("p", "Derivatives from at most " + std::to_string(comparison.plan.rays) +
                       " jittered rays at a receiver, seed " + std::to_string(comparison.plan.seed) +
                       ", against the exact ones; estimators with one stratification share their rays.") +
      '\n';
  std::string sentences;
  for (const std::string& sentence : comparisonSentences(comparison)) sentences += element("li", escaped(sentence));
  html += element("ul", sentences) + '\n';
  html +=
      element("p",
              "The relative error at a receiver is max|estimate - truth| / max|truth| over the components; median "
              "and 99 % are over the receivers, RMS is the root mean square of max|estimate - truth| over that of "
              "max|truth|. The gradient is that along the plane, the Hessian the tangential one. Constant radiance: "
              "the largest component at any of a few receivers on the floor of a box of radiance 1." +
                  orderText(curves)) +
      '\n';
  for (const EstimatorComparison::InScene& in : comparison.scenes) html += sceneTable(comparison, in, curves);
  std::string plots;
  std::size_t number = 0;
  for (const QualityFigure::Curves& group : curves) {
    for (const Compared compared : {Compared::kGradient, Compared::kHessian}) {
      const std::string title = std::string("Error of the ") + wordFor(compared) + " against rays, " + group.scene.name;
      plots += element("figure", element("figcaption", escaped(title)) +
                                     inlineSvg(convergencePlot(group.curves, compared),
                                               "estimators" + std::to_string(number++) + '-', title)) +
               '\n';
    }
  }
  html += element("div", plots, "class=\"plots\"") + '\n';
  html += element("p", "With every digit: estimators.csv and estimators.json; the curves: figure6/curves.csv.") + '\n';
  return {"estimators", "Derivatives from hemisphere samples", html};
}

}  // namespace irradiff
