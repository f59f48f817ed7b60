#include "experiments/atlas/atlas_page.h"

#include "derivatives/scene/number_text.h"
#include "experiments/atlas/atlas_pictures.h"
#include "experiments/atlas/atlas_text.h"
#include "experiments/io/base64.h"
#include "verification/report/html.h"
#include "verification/report/page_sections.h"
#include "verification/report/page_style.h"

#include <algorithm>

namespace irradiff {
namespace {

constexpr std::size_t kHessian = kAtlasQuantities - 1;

std::string regionCell(const SafetyStatement& statement, const StabilityMap& map) {
  std::string cell = escaped(textOf(statement.region, map.x, map.y));
  if (statement.violations > 0) {
    cell += ' ' + badge("fails at " + std::to_string(statement.violations) + " of " +
                            std::to_string(statement.checked) + " fresh inputs",
                        "wrong");
  }
  return cell;
}

std::string regionTableHtml(const Atlas& atlas, const StabilityMap& map, std::size_t quantity) {
  std::vector<std::string> headings = {"formula"};
  for (const double tolerance : kAtlasTolerances) headings.push_back("safe for " + numberText(tolerance));
  HtmlTable table(headings);
  for (const VariantErrors& variant : map.variants) {
    std::vector<std::string> cells = {escaped(variant.name())};
    for (const SafetyStatement& s : atlas.statements) {
      const bool is_of_row =
          s.map == map.file && s.formula == variant.formula && s.scalar == variant.scalar && s.quantity == quantity;
      if (is_of_row) cells.push_back(regionCell(s, map));
    }
    table.add(cells);
  }
  return table.html();
}

std::string sheetHtml(const RgbImage& sheet, const StabilityMap& map, std::size_t quantity) {
  return "<img src=\"data:image/png;base64," + base64(pngFile(sheet)) + "\" alt=\"" +
         escaped("errors of the " + std::string(kAtlasQuantityNames[quantity]) + ", " + map.title) +
         "\" style=\"max-width:100%\">\n";
}

std::string quantityHtml(const Atlas& atlas, const StabilityMap& map, const RgbImage& sheet, std::size_t quantity) {
  const std::string name = kAtlasQuantityNames[quantity];
  const std::string content = sheetHtml(sheet, map, quantity) + regionTableHtml(atlas, map, quantity);
  return quantity == kHessian ? element("h3", name) + content
                              : element("details", element("summary", name) + content) + '\n';
}

std::string paragraphs(const std::vector<std::string>& texts) {
  std::string html;
  for (const std::string& text : texts) html += element("p", escaped(text)) + '\n';
  return html;
}

}  // namespace

std::string atlasPage(const Atlas& atlas, const RunRecord& record,
                      const std::vector<std::array<RgbImage, kAtlasQuantities>>& sheets) {
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += element("title", "irradiff: stability atlas") + '\n';
  page += element("style", kPageStyle) + "\n</head>\n<body>\n";
  page += element("h1", "Stability atlas") + '\n';
  page +=
      element("p",
              "What each way to compute the form factor of a polygon and its derivatives makes of the extremes, and "
              "the inequalities that keep it safe.");
  page += paragraphs(readingGuide()) + element("p", checkText(atlas)) + '\n';
  page +=
      element("p",
              "irradiff " + escaped(record.version) + ", " + escaped(record.date) + ", " + escaped(record.compiler) +
                  ", " + escaped(record.machine) + ", seed " + std::to_string(atlas.plan.seed),
              "class=\"soft\"");
  std::string links;
  for (const StabilityMap& map : atlas.maps) {
    links += element("li", element("a", escaped(map.title), "href=\"#" + escaped(map.file) + '"'));
  }
  page += element("nav", element("ul", links)) + '\n';
  page += element("h2", "Where the errors come from") + '\n' + paragraphs(errorLaws());
  for (std::size_t m = 0; m < atlas.maps.size(); ++m) {
    const StabilityMap& map = atlas.maps[m];
    page += element("h2", escaped(map.title), "id=\"" + escaped(map.file) + '"') + '\n';
    page +=
        element("p", escaped(map.description) + ' ' + std::to_string(map.cells) + " x " + std::to_string(map.cells) +
                         " cells, " + std::to_string(map.samples) + " inputs in each.") +
        '\n';
    for (std::size_t quantity = kAtlasQuantities; quantity-- > 0;) {
      page += quantityHtml(atlas, map, sheets.at(m)[quantity], quantity);
    }
  }
  page +=
      element("h2", "Files") +
      element("p",
              "For each map an .exr with a channel for each variant and quantity, 32-bit floats (1e38 where a result "
              "was not finite, NaN where the input is not held), and a .png for each quantity; "
              "<a href=\"regions.csv\">regions.csv</a> and <a href=\"regions.json\">regions.json</a>: the "
              "inequalities; <a href=\"run.json\">run.json</a>: how this was made.");
  return page + "\n</body>\n</html>\n";
}

FurtherSection atlasSection(const Atlas& atlas) {
  std::string html = paragraphs(readingGuide()) + element("p", checkText(atlas) + " Regions for the Hessian:") + '\n';
  for (const StabilityMap& map : atlas.maps) {
    html += element("h3", escaped(map.title)) + '\n' + element("p", escaped(map.description)) +
            regionTableHtml(atlas, map, kHessian) + '\n';
  }
  html +=
      element("p",
              "Maps in colours, and the regions of F and of the gradient: "
              "<a href=\"atlas/index.html\">atlas/index.html</a>. Some regions of a coarse atlas have been tested with "
              "few inputs "
              "(<code>fresh_inputs</code> in atlas/regions.csv); for code take those of docs/atlas.md, or of a finer "
              "<code>irradiff atlas</code>.");
  return {"atlas", "Where each formula is safe", html};
}

}  // namespace irradiff
