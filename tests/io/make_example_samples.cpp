// Writes data/samples/figure5_concentric_16x16.json to standard output. Run it in the project's root.

#include "tests/io/example_samples.h"

#include <iostream>

int main() {
  std::cout << irradiff::exampleSamplesText();
  return std::cout ? 0 : 1;
}
