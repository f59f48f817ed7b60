#include "experiments/atlas/safe_region.h"

#include "derivatives/scene/number_text.h"
#include "verification/report/parallel_tasks.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace irradiff {
namespace {

/// The powers of x and y in a slanted line.
constexpr std::array<std::array<int, 2>, 12> kSlopes = {
    {{1, 1}, {1, -1}, {-1, 1}, {-1, -1}, {2, 1}, {2, -1}, {-2, 1}, {-2, -1}, {1, 2}, {1, -2}, {-1, 2}, {-1, -2}}};

/// A slanted line x_power log10(x) + y_power log10(y) >= level, all three counted from the lower left corner of a map.
struct Slant {
  int x_power = 0;
  int y_power = 0;
  double level = 0.0;
  double per_column = 0.0;  ///< what a cell to the right adds to the left side
  double per_row = 0.0;

  double leastIn(std::size_t column, std::size_t row) const {
    return at(column, row) + std::min(0.0, per_column) + std::min(0.0, per_row);
  }
  double greatestIn(std::size_t column, std::size_t row) const {
    return at(column, row) + std::max(0.0, per_column) + std::max(0.0, per_row);
  }

 private:
  double at(std::size_t column, std::size_t row) const {
    return per_column * static_cast<double>(column) + per_row * static_cast<double>(row);
  }
};

/// Columns [left, right) and rows [low, high).
struct Rectangle {
  std::size_t left = 0;
  std::size_t right = 0;
  std::size_t low = 0;
  std::size_t high = 0;

  /// How many of its sides are not those of the map.
  int sidesWithin(std::size_t cells) const {
    return (left > 0 ? 1 : 0) + (right < cells ? 1 : 0) + (low > 0 ? 1 : 0) + (high < cells ? 1 : 0);
  }
};

/// How many cells of a set are in a rectangle that begins at the corner.
class CellCounts {
 public:
  template <class Contains>
  CellCounts(std::size_t cells, const Contains& contains) : side_(cells + 1), sums_(side_ * side_, 0) {
    for (std::size_t row = 0; row < cells; ++row) {
      for (std::size_t column = 0; column < cells; ++column) {
        sums_[(row + 1) * side_ + column + 1] = sums_[row * side_ + column + 1] + sums_[(row + 1) * side_ + column] -
                                                sums_[row * side_ + column] + (contains(column, row) ? 1 : 0);
      }
    }
  }

  int in(const Rectangle& r) const {
    return at(r.right, r.high) - at(r.left, r.high) - at(r.right, r.low) + at(r.left, r.low);
  }

 private:
  int at(std::size_t column, std::size_t row) const { return sums_[row * side_ + column]; }

  std::size_t side_;
  std::vector<int> sums_;
};

/// Calls visit(rectangle) for every rectangle free of forbidden cells that none larger contains, and for others.
template <class IsForbidden, class Visit>
void visitFreeRectangles(std::size_t cells, const IsForbidden& is_forbidden, const Visit& visit) {
  std::vector<std::size_t> heights(cells, 0);  // free cells from this row downwards
  struct Step {
    std::size_t column;
    std::size_t height;
  };
  std::vector<Step> steps;
  for (std::size_t row = 0; row < cells; ++row) {
    for (std::size_t column = 0; column < cells; ++column) {
      heights[column] = is_forbidden(column, row) ? 0 : heights[column] + 1;
    }
    steps.clear();
    for (std::size_t column = 0; column <= cells; ++column) {
      const std::size_t height = column < cells ? heights[column] : 0;
      std::size_t left = column;
      while (!steps.empty() && steps.back().height >= height) {
        left = steps.back().column;
        if (steps.back().height > 0) visit(Rectangle{left, column, row + 1 - steps.back().height, row + 1});
        steps.pop_back();
      }
      steps.push_back({left, height});
    }
  }
}

struct Cut {
  Rectangle rectangle;
  Slant slant;
  int cells = 0;
  double worth = 0.0;
};

std::vector<bool> safeCells(std::size_t cells, const std::vector<double>& errors, double tolerance) {
  std::vector<bool> safe(errors.size());
  for (std::size_t row = 0; row < cells; ++row) {
    for (std::size_t column = 0; column < cells; ++column) {
      bool is_safe = errors[row * cells + column] <= tolerance / kSafetyMargin;
      for (std::size_t r = row - (row > 0 ? 1 : 0); r <= std::min(cells - 1, row + 1); ++r) {
        for (std::size_t c = column - (column > 0 ? 1 : 0); c <= std::min(cells - 1, column + 1); ++c) {
          is_safe = is_safe && errors[r * cells + c] <= tolerance;  // false for NaN
        }
      }
      safe[row * cells + column] = is_safe;
    }
  }
  return safe;
}

/// The cut with most whole cells, all that it touches being safe.
Cut largestCut(const StabilityMap& map, const std::vector<bool>& safe) {
  const std::size_t cells = map.cells;
  Cut best;
  const auto worthOf = [](int count, int inequalities) {
    return count * std::pow(1.0 - kWorthOfInequality, inequalities);
  };
  std::size_t forbidden_before = 0;
  // Whether a line that cuts away more, but is otherwise like this one, may still be better.
  const auto try_slant = [&](const Slant& slant) {
    const int slants = slant.x_power != 0 ? 1 : 0;
    int safe_inside = 0;
    std::size_t forbidden = 0;
    for (std::size_t r = 0; r < cells; ++r) {
      for (std::size_t c = 0; c < cells; ++c) {
        const bool is_safe = safe[r * cells + c];
        if (is_safe && slant.leastIn(c, r) >= slant.level) ++safe_inside;
        if (!is_safe && slant.greatestIn(c, r) > slant.level) ++forbidden;
      }
    }
    if (worthOf(safe_inside, slants) <= best.worth) return false;
    // What only cuts away safe cells is no better than the line before.
    if (slants == 1 && forbidden == forbidden_before) return true;
    forbidden_before = forbidden;
    const CellCounts inside(cells, [&](std::size_t c, std::size_t r) { return slant.leastIn(c, r) >= slant.level; });
    visitFreeRectangles(
        cells,
        [&](std::size_t c, std::size_t r) { return !safe[r * cells + c] && slant.greatestIn(c, r) > slant.level; },
        [&](const Rectangle& rectangle) {
          const int count = inside.in(rectangle);
          const double worth = worthOf(count, rectangle.sidesWithin(cells) + slants);
          if (worth > best.worth) best = {rectangle, slant, count, worth};
        });
    return true;
  };
  const auto side = static_cast<double>(cells);
  const double column = std::log10(map.x.high / map.x.low) / side;
  const double row = std::log10(map.y.high / map.y.low) / side;
  Slant none;
  none.level = -1.0;
  try_slant(none);
  for (const auto& [p, q] : kSlopes) {
    Slant slant{p, q, 0.0, p * column, q * row};
    const double least = side * (std::min(0.0, slant.per_column) + std::min(0.0, slant.per_row));
    const double greatest = side * (std::max(0.0, slant.per_column) + std::max(0.0, slant.per_row));
    // From the line that cuts least away on; what is inside only shrinks.
    const std::size_t levels = 2 * cells;
    for (std::size_t i = 1; i < levels; ++i) {
      slant.level = least + (greatest - least) * static_cast<double>(i) / static_cast<double>(levels);
      if (!try_slant(slant)) break;
    }
  }
  return best;
}

/// To two digits, away from what the inequality excludes.
double roundedInwards(double bound, bool is_at_least) {
  const double unit = std::pow(10.0, std::floor(std::log10(bound)) - 1.0);
  const double steps = bound / unit;
  // What rounding made of a bound of two digits stays what it is.
  const long digits = std::lround(is_at_least ? std::ceil(steps - 1e-9) : std::floor(steps + 1e-9));
  return std::stod(std::to_string(digits) + "e" + std::to_string(std::lround(std::log10(unit))));
}

}  // namespace

bool SizeInequality::holds(double x, double y) const {
  const double power = std::pow(x, x_power) * std::pow(y, y_power);
  return is_at_least ? power >= bound : power <= bound;
}

bool SafeRegion::contains(double x, double y) const {
  return std::ranges::all_of(inequalities, [&](const SizeInequality& i) { return i.holds(x, y); });
}

std::optional<SafeRegion> largestSafeRegion(const StabilityMap& map, const std::vector<double>& errors,
                                            double tolerance) {
  const std::size_t cells = map.cells;
  const Cut cut = largestCut(map, safeCells(cells, errors, tolerance));
  SafeRegion region;
  region.share = static_cast<double>(cut.cells) / static_cast<double>(cells * cells);
  if (region.share < kLeastShare) return std::nullopt;
  const auto place = [&](const AtlasAxis& axis, double cell) {
    return axis.low * std::pow(axis.high / axis.low, cell / static_cast<double>(cells));
  };
  const auto add = [&](int x_power, int y_power, bool is_at_least, double bound) {
    region.inequalities.push_back({x_power, y_power, is_at_least, roundedInwards(bound, is_at_least)});
  };
  const Rectangle& r = cut.rectangle;
  if (r.left > 0) add(1, 0, true, place(map.x, static_cast<double>(r.left)));
  if (r.right < cells) add(1, 0, false, place(map.x, static_cast<double>(r.right)));
  if (r.low > 0) add(0, 1, true, place(map.y, static_cast<double>(r.low)));
  if (r.high < cells) add(0, 1, false, place(map.y, static_cast<double>(r.high)));
  if (const Slant& s = cut.slant; s.x_power != 0) {
    const double corner = s.x_power * std::log10(map.x.low) + s.y_power * std::log10(map.y.low);
    const bool is_inverse = s.x_power < 0 && s.y_power < 0;
    const int sign = is_inverse ? -1 : 1;
    add(sign * s.x_power, sign * s.y_power, !is_inverse, std::pow(10.0, sign * (corner + s.level)));
  }
  return region;
}

std::vector<SafetyStatement> safetyStatements(const std::vector<StabilityMap>& maps, unsigned threads,
                                              const QualityProgress& progress) {
  std::vector<SafetyStatement> statements;
  std::vector<std::function<void()>> tasks;
  for (const StabilityMap& map : maps) {
    for (const VariantErrors& variant : map.variants) {
      for (std::size_t quantity = 0; quantity < kAtlasQuantities; ++quantity) {
        for (const double tolerance : kAtlasTolerances) {
          const std::size_t place = statements.size();
          statements.push_back({map.file, variant.formula, variant.scalar, quantity, tolerance, {}, 0, 0});
          tasks.emplace_back([&, quantity, tolerance, place] {
            statements[place].region = largestSafeRegion(map, variant.peak[quantity], tolerance);
          });
        }
      }
    }
  }
  runTasks(tasks, threads, [&](std::size_t done, std::size_t all) {
    if (progress) progress("safe regions", done, all);
  });
  return statements;
}

std::string textOf(const std::optional<SafeRegion>& region, const AtlasAxis& x, const AtlasAxis& y) {
  if (!region) return "nowhere";
  if (region->inequalities.empty()) return "everywhere";
  const auto powerOf = [](const std::string& name, int power) {
    return std::abs(power) == 1 ? name : "(" + name + ")^" + std::to_string(std::abs(power));
  };
  std::string text;
  for (const SizeInequality& i : region->inequalities) {
    std::string left;
    if (i.y_power == 0) {
      left = x.name;
    } else if (i.x_power == 0) {
      left = y.name;
    } else if (i.x_power < 0) {
      left = powerOf(y.name, i.y_power) + " / (" + powerOf(x.name, i.x_power) + ")";
    } else {
      const std::string by = powerOf(y.name, i.y_power);
      left = powerOf(x.name, i.x_power) + (i.y_power < 0 ? " / (" + by + ")" : " * " + by);
    }
    text += (text.empty() ? "" : " and ") + left + (i.is_at_least ? " >= " : " <= ") + numberText(i.bound);
  }
  return text;
}

}  // namespace irradiff
