// The gradient of a hard case, certified to 30 digits, and how far from it the three numbers on the command line are.
#include "verification/certified/certified_polygon.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

int main(int count, char** arguments) {
  // data/hard_cases/sliver.json: a triangle a billion times longer than wide.
  const irradiff::Polygon sliver{"sliver", {{-1, 0, 1}, {1, 0, 1}, {0.1, 1e-9, 1}}, 1.0};
  const irradiff::Receiver receiver{{0.25, -0.5, 0}, {0, 0, 1}};
  const irradiff::CertifiedPolygon certified = irradiff::certifyPolygon(sliver, 0, receiver, 1e-30);
  const auto& gradient = certified.enclosure->gradient.value;  // balls: a number and a proven radius about it
  std::printf("rung: %s\n", irradiff::nameOf(certified.rung));
  double norm = 0.0, error = 0.0;
  for (int i = 0; i < 3; ++i) {
    std::printf("dE/d%c = %s\n", "xyz"[i], gradient(i).toDecimal(40).c_str());
    norm = std::max(norm, gradient(i).magnitude().toDouble());
    if (count == 4) {
      const irradiff::Ball difference = irradiff::Ball(std::atof(arguments[i + 1])) - gradient(i);
      error = std::max(error, difference.magnitude().toDouble());
    }
  }
  if (count != 4) return 0;
  const bool is_right = error <= 1e-12 * norm;
  std::printf("yours: %s, off by %.1e of the largest\n", is_right ? "right" : "WRONG", error / norm);
  return is_right ? 0 : 1;
}
