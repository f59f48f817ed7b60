#include "verification/checks/square_mean.h"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace irradiff {
namespace {

struct Cell {
  double s, t, width, height;
  double integral = 0.0;
  double error = 0.0;
};

template <unsigned Points>
double integralOver(const Cell& cell, const std::function<double(double, double)>& f) {
  using Rule = boost::math::quadrature::gauss<double, Points>;
  return Rule::integrate(
      [&](double s) { return Rule::integrate([&](double t) { return f(s, t); }, cell.t, cell.t + cell.height); },
      cell.s, cell.s + cell.width);
}

Cell cellAt(double s, double t, double width, double height, const std::function<double(double, double)>& f) {
  Cell cell{s, t, width, height};
  cell.integral = integralOver<12>(cell, f);
  cell.error = std::abs(cell.integral - integralOver<8>(cell, f));
  // A value that is not a number is the worst there is: it must not hide at the bottom of the heap.
  if (!std::isfinite(cell.error)) {
    cell.error = std::numeric_limits<double>::infinity();
  }
  return cell;
}

}  // namespace

SquareMean meanOverUnitSquare(const std::function<double(double, double)>& f, double side_s, double side_t,
                              double allowed) {
  constexpr std::size_t kMaximumCells = 400;
  const auto is_better = [](const Cell& a, const Cell& b) { return a.error < b.error; };
  const auto sum = [](const std::vector<Cell>& cells) {
    SquareMean mean;
    for (const Cell& cell : cells) {
      mean.value += cell.integral;
      mean.error += cell.error;
    }
    return mean;
  };
  std::vector<Cell> cells = {cellAt(0.0, 0.0, 1.0, 1.0, f)};
  SquareMean mean = sum(cells);
  while (mean.error > allowed && std::isfinite(mean.error) && cells.size() < kMaximumCells) {
    std::pop_heap(cells.begin(), cells.end(), is_better);
    const Cell worst = cells.back();
    cells.pop_back();
    const bool is_wide = worst.width * side_s >= worst.height * side_t;
    const double width = is_wide ? 0.5 * worst.width : worst.width;
    const double height = is_wide ? worst.height : 0.5 * worst.height;
    for (const Cell& half :
         {cellAt(worst.s, worst.t, width, height, f),
          cellAt(worst.s + worst.width - width, worst.t + worst.height - height, width, height, f)}) {
      cells.push_back(half);
      std::push_heap(cells.begin(), cells.end(), is_better);
    }
    mean = sum(cells);
  }
  return mean;
}

}  // namespace irradiff
