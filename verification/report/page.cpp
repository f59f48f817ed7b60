#include "verification/report/page.h"

#include "verification/report/figure_text.h"
#include "verification/report/html.h"
#include "verification/report/page_sections.h"
#include "verification/report/page_style.h"

#include <stdexcept>

namespace irradiff {

void HtmlTable::add(const std::vector<std::string>& cells) {
  if (cells.size() != headings_.size()) {
    throw std::invalid_argument("a row of " + std::to_string(cells.size()) + " cells in a table of " +
                                std::to_string(headings_.size()) + " columns");
  }
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    row += element("td", element("span", cells[i]), "data-column=\"" + escaped(headings_[i]) + '"');
  }
  rows_ += element("tr", row) + '\n';
}

std::string HtmlTable::html() const {
  std::string head;
  for (const std::string& heading : headings_) {
    head += element("th", escaped(heading), "scope=\"col\"");
  }
  const std::string table = element("table", element("thead", element("tr", head)) + element("tbody", '\n' + rows_));
  return element("div", table, "class=\"scroll\"") + '\n';
}

std::string badge(const std::string& text, const std::string& kind) {
  return element("span", escaped(text), "class=\"badge " + kind + '"');
}

namespace {

std::string furtherPagesSection(const std::vector<FurtherPage>& pages) {
  std::string items;
  for (const FurtherPage& page : pages) {
    items += element(
        "li", element("a", escaped(page.title), "href=\"" + escaped(page.path) + '"') + ": " + escaped(page.summary));
  }
  return items.empty() ? "" : element("h2", "Further pages", "id=\"further\"") + '\n' + element("ul", items) + '\n';
}

}  // namespace

std::string reportPage(const AccuracyReport& report, const RunRecord& record, const std::vector<SweepPlot>& plots,
                       const FurtherContent& further) {
  std::string further_links;
  for (const FurtherSection& section : further.sections) {
    further_links += element("li", element("a", escaped(section.title), "href=\"#" + escaped(section.id) + '"'));
  }
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += element("title", "irradiff: derivative accuracy report") + '\n';
  page += element("style", kPageStyle) + "\n</head>\n<body>\n";
  page += element("h1", "Irradiance, its gradient and its Hessian: how far can the numbers be trusted?") + '\n';
  page += summarySection(report, record);
  page +=
      element("nav",
              element("ul", element("li", "<a href=\"#legend\">How to read this</a>") +
                                element("li", "<a href=\"#checks\">Checks</a>") +
                                element("li", "<a href=\"#plots\">Error against size</a>") +
                                element("li", "<a href=\"#errata\">Errata</a>") +
                                element("li", "<a href=\"#gap-filling\">Filled gaps</a>") +
                                element("li", "<a href=\"#tightness\">Bounds over errors</a>") +
                                element("li", "<a href=\"#references\">Reference values</a>") + further_links +
                                (further.pages.empty() ? "" : element("li", "<a href=\"#further\">Further pages</a>")) +
                                element("li", "<a href=\"#files\">Files</a>"))) +
      '\n';
  page += legendSection();
  page += checksSection(report);
  page += plotsSection(report, plots);
  page += errataSection(report);
  page += gapFillingSection(report);
  page += tightnessSection(report);
  page += referencesSection(report);
  for (const FurtherSection& section : further.sections) {
    page += element("h2", escaped(section.title), "id=\"" + escaped(section.id) + '"') + '\n' + section.html;
  }
  page += furtherPagesSection(further.pages);
  page += element("h2", "Files", "id=\"files\"") + '\n';
  page +=
      element("p",
              "The tables of this page, with every digit: verdicts, sweeps, errata, gap_filling and bound_tightness, "
              "each as .csv and "
              ".json; "
              "the plots in plots/; the run in run.json; the summary in accuracy.md. Speed is measured separately, by "
              "<code>./run bench</code>.") +
      '\n';
  page += "</body>\n</html>\n";
  return page;
}

}  // namespace irradiff
