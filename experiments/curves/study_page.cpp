#include "experiments/curves/study_page.h"

#include "experiments/curves/study_gains.h"
#include "experiments/curves/study_page_style.h"
#include "experiments/curves/study_text.h"
#include "experiments/figures/figure_page.h"
#include "experiments/figures/figure_page_style.h"
#include "verification/report/html.h"
#include "verification/report/page_sections.h"
#include "verification/report/page_style.h"

#include <algorithm>

namespace irradiff {

namespace {

constexpr const char* kFirstLeft = "bounded-split-sphere, footprints";
constexpr const char* kFirstRight = "occlusion-hessian, footprints";

std::string tableHtml(const TextTable& table) {
  if (table.rows.empty()) return "";
  HtmlTable html(table.headings);
  for (const std::vector<std::string>& row : table.rows) {
    std::vector<std::string> cells;
    for (const std::string& cell : row) cells.push_back(escaped(cell));
    html.add(cells);
  }
  return element("div", html.html(), "class=\"scroll\"") + '\n';
}

std::string titled(const std::string& title, const std::string& content) {
  return content.empty() ? "" : element("h3", escaped(title)) + '\n' + content;
}

std::string listHtml(const std::vector<std::string>& sentences) {
  std::string items;
  for (const std::string& sentence : sentences) items += element("li", escaped(sentence)) + '\n';
  return element("ul", items, "class=\"conclusion\"") + '\n';
}

std::string paragraphs(const std::vector<std::string>& texts) {
  std::string html;
  for (const std::string& text : texts) html += element("p", escaped(text)) + '\n';
  return html;
}

std::string namedPicture(MapPicture picture, const std::string& name, const std::string& note) {
  picture.name = name;
  return pictureHtml({std::move(picture), {}, note});
}

std::string sliderHtml() {
  const std::string choices = element("label", "Left: " + element("select", "", "class=\"left\"")) +
                              element("label", "Right: " + element("select", "", "class=\"right\""));
  const std::string stage =
      "<img class=\"under\" alt=\"the picture on the right\"><img class=\"over\" alt=\"the picture on the left\">";
  return element("div",
                 element("div", choices, "class=\"choices\"") + element("div", stage, "class=\"stage\"") +
                     "<input type=\"range\" class=\"divide\" min=\"0\" max=\"100\" value=\"50\" "
                     "aria-label=\"where the left picture ends\">" +
                     element("div",
                             element("div", "", "class=\"scale-left\"") + element("div", "", "class=\"scale-right\""),
                             "class=\"scales\""),
                 "class=\"slider screen\" hidden data-left=\"" + escaped(kFirstLeft) + "\" data-right=\"" +
                     escaped(kFirstRight) + '"') +
         '\n';
}

std::string picturesHtml(const SceneStudy& scene) {
  std::string figures;
  for (const MetricPictures& shown : scene.pictures) {
    const std::string note = ' ' + std::to_string(shown.records) + " records.";
    figures += namedPicture(shown.footprints, shown.metric + ", footprints", note) +
               namedPicture(shown.radii, shown.metric + ", radii", "") +
               namedPicture(shown.errors, shown.metric + ", error", note);
  }
  for (const RatioPictures& shown : scene.ratio_pictures) {
    if (shown.metric == "oracle") continue;
    figures += namedPicture(shown.radii, shown.metric + ", radius over the oracle's", "") +
               namedPicture(shown.errors, shown.metric + ", true error over the oracle's", "");
  }
  figures += namedPicture(scene.reference, "reference", "");
  return element("section", sliderHtml() + element("div", '\n' + figures, "class=\"pictures\"")) + '\n';
}

std::string sceneHtml(const SceneStudy& scene, const ScenePlots& plots) {
  std::string html = element("h2", escaped(scene.name), "id=\"" + escaped(scene.name) + '"') + '\n' +
                     element("p", escaped(scene.description)) + '\n' + element("p", escaped(sceneText(scene))) + '\n';
  const std::string prefix = scene.name + '-';
  html += element("div", inlineSvg(plots.curves, prefix + "curves-", "RMS error against records, " + scene.name),
                  "class=\"scroll\"") +
          '\n';
  html += titled("RMS error against records", tableHtml(errorText(scene)));
  html += titled("Figure 1 at " + std::to_string(scene.table_records) + " records", tableHtml(orderText(scene)));
  html += titled("Ours beside the best", tableHtml(gainText(scene)));
  html += titled(kAblationTitle, tableHtml(ablationText(scene)));
  if (!plots.ratios.empty()) {
    html += titled(
        "Regions beside the oracle's at " + std::to_string(scene.ratio_records) + " records",
        element("div", inlineSvg(plots.ratios, prefix + "ratios-", "Regions beside the oracle's"), "class=\"scroll\"") +
            '\n' + tableHtml(ratioText(scene)));
  }
  return html + titled("Where", picturesHtml(scene));
}

std::string comparisonHtml(const CacheComparison& comparison) {
  const std::string number = comparison.id.substr(std::string("figure").size());
  std::string figures;
  for (const VariantResult& result : comparison.results) {
    figures += namedPicture(result.footprints, result.label + ", footprints", "") +
               namedPicture(result.radii, result.label + ", radii", "") +
               namedPicture(result.errors, result.label + ", error", "");
  }
  return element("h2", "Figure " + number + ": " + escaped(comparison.title), "id=\"" + comparison.id + '"') + '\n' +
         element("p", escaped(comparison.question)) + '\n' + tableHtml(comparisonText(comparison)) +
         listHtml(comparison.findings) +
         element("details", element("summary", "Pictures") + element("div", '\n' + figures, "class=\"pictures\"")) +
         '\n';
}

std::string linksHtml(const MetricStudy& study) {
  std::string links;
  for (const SceneStudy& scene : study.scenes) {
    links += element("li", element("a", escaped(scene.name), "href=\"#" + escaped(scene.name) + '"'));
  }
  for (const CacheComparison& comparison : study.comparisons) {
    links += element("li", element("a", "Figure " + comparison.id.substr(std::string("figure").size()),
                                   "href=\"#" + comparison.id + '"'));
  }
  return element("nav", element("ul", links)) + '\n';
}

}  // namespace

std::string studyPage(const MetricStudy& study, const RunRecord& record, const std::vector<ScenePlots>& plots) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += element("title", "irradiff: error metrics") + '\n' +
          element("style", std::string(kPageStyle) + std::string(kFigurePageStyle) + std::string(kStudyPageStyle)) +
          "\n</head>\n<body>\n" + element("h1", "Error metrics") + '\n';
  page += paragraphs(studyGuide(study));
  page += element("p",
                  "irradiff " + escaped(record.version) + ", " + escaped(record.date) + ", " +
                      escaped(record.compiler) + ", " + escaped(record.machine),
                  "class=\"soft\"") +
          '\n' + linksHtml(study);
  page += element("h2", "What we conclude", "id=\"conclusion\"") + '\n' + listHtml(conclusionSentences(study));
  for (std::size_t i = 0; i < study.scenes.size(); ++i) page += sceneHtml(study.scenes[i], plots.at(i));
  for (const CacheComparison& comparison : study.comparisons) page += comparisonHtml(comparison);
  page += element("h2", "Files") + element("p",
                                           "curves, ablation, slopes, ratios, table and figures as .csv and .json; the "
                                           "plots as .svg; a folder of .png for "
                                           "each scene and for the figures; metrics.md, this page as text; run.json.");
  return page + '\n' + element("script", kStudyPageScript) + "\n</body>\n</html>\n";
}

FurtherSection studySection(const MetricStudy& study, const std::string& page) {
  std::string html = listHtml(conclusionSentences(study));
  for (const SceneStudy& scene : study.scenes) {
    html += titled(scene.name + ": RMS error against records", tableHtml(errorText(scene)));
    html += titled(scene.name + ": regions beside the oracle's", tableHtml(ratioText(scene)));
    html += titled(scene.name + ": Figure 1 at " + std::to_string(scene.table_records) + " records",
                   tableHtml(orderText(scene)));
    html += titled(scene.name + ": ours beside the best", tableHtml(gainText(scene)));
    html += titled(scene.name + ": what second order is made of", tableHtml(ablationText(scene)));
  }
  html +=
      element("p", "Curves and pictures: " + element("a", escaped(page), "href=\"" + escaped(page) + '"') + '.') + '\n';
  return {"metrics", "Error metrics", html};
}

}  // namespace irradiff
