#include "tests/closed_forms/adaptive_quadrature.h"
#include "tests/closed_forms/entry_verdict.h"
#include "verification/closed_forms/closed_form_formulas.h"
#include "verification/closed_forms/closed_forms.h"

#include <gtest/gtest.h>

#include <limits>

namespace irradiff::closed_forms_test {
namespace {

// Form factor from the receiver (x, y, 0), facing up, to a polygon as closedFormsBetweenAreas() makes them: from the
// line through its first vertex along y to the one through its second. By the closed forms from a receiver, which
// closed_forms_test.cpp checks against the defining integral.
long double formFactorAt(long double x, long double y, const Polygon& polygon) {
  const auto& v = polygon.vertices;
  const long double y0 = v[0].y() - y;
  const long double y1 = v[2].y() - y;
  if (v[0].z() == v[1].z()) return parallelRectangle<long double>(v[0].x() - x, v[1].x() - x, y0, y1, v[0].z());
  if (v[0].x() == v[1].x()) return perpendicularRectangle<long double>(v[0].z(), v[1].z(), y0, y1, x - v[0].x());
  return infiniteTiltedStrip<long double>(v[1].x(), v[1].z(), x);
}

Quadrature meanOverReceivingArea(const Polygon& polygon, const ReceivingParallelogram& area) {
  const auto integrand = [&](long double s, long double t) {
    return formFactorAt(area.corner.x() + (1 + s) / 2 * area.edge_u.x(),
                        area.corner.y() + (1 + t) / 2 * area.edge_v.y(), polygon) /
           4;
  };
  // The superposition adds four terms, each below 1/2 and off by a few roundings; their sum may be far smaller.
  constexpr long double kNoise = 4 * std::numeric_limits<long double>::epsilon();
  return integrateOverSquare(integrand, area.edge_u.norm(), area.edge_v.norm(), kNoise);
}

bool sidesMayBeSwapped(const ClosedFormBetweenAreas& form, std::size_t i, std::size_t j) {
  return form.catalogue_number == "C-11" && i == 0 && j == 1;
}

TEST(ClosedFormsBetweenAreas, AreMeansOfClosedFormsFromReceivers) {
  expectAgreement(closedFormsBetweenAreas(), meanOverReceivingArea, sidesMayBeSwapped, 1e-9L);
}

}  // namespace
}  // namespace irradiff::closed_forms_test
