// generate_reference [--only FAMILY] --output DIR
//
// Writes the reference values of data/reference: each from a proven enclosure of the defining integral, and each
// compared with differences of a contour formula before it is written. Nothing here includes or links the formulas
// under test.

#include "data/reference/reference_inputs.h"
#include "verification/enclosure/area_integral.h"
#include "verification/enclosure/contour_integral.h"
#include "verification/enclosure/flatland_integral.h"
#include "verification/enclosure/polar_integral.h"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace irradiff {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kProvenDigits = 48;
constexpr int kPrintedDigits = 50;

std::string hexFloat(double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%a", value);
  return text.data();
}

template <class Vector>
Json hexFloats(const Vector& vector) {
  Json list = Json::array();
  for (const double component : vector) list.push_back(hexFloat(component));
  return list;
}

/// Prints components, and keeps the largest distance from a print to any number in its ball.
class DecimalPrinter {
 public:
  std::string print(const Ball& ball) {
    const std::string text = ball.containsZero() ? "0" : ball.midpointToDecimal(kPrintedDigits);
    const Ball distance = (ball - Ball::fromDecimal(text)).magnitude();
    error_ = max(error_, distance);
    return text;
  }

  /// Two digits, rounded up.
  std::string error() const { return (error_ * Ball(1.1)).midpointToDecimal(2); }

 private:
  Ball error_;
};

/// Every component of the certified enclosure must meet the estimated one, and the estimate must be worth comparing
/// with: known to kProvenDigits of the largest component, unless the quantity is zero.
template <class Certified, class Estimated>
void requireAgreement(const Certified& certified, const Estimated& estimated, const std::string& what) {
  Ball norm;
  for (const Ball& component : certified.reshaped()) norm = max(norm, abs(component.midpoint()));
  const Ball allowed = norm * Ball::fromDecimal("1e-" + std::to_string(kProvenDigits));
  for (Eigen::Index i = 0; i < certified.rows(); ++i) {
    for (Eigen::Index j = 0; j < certified.cols(); ++j) {
      const Ball& estimate = estimated(i, j);
      if (!estimate.overlaps(certified(i, j)) || (norm > Ball(0) && !(estimate.radius() < allowed))) {
        throw std::runtime_error(what + " (" + std::to_string(i) + ", " + std::to_string(j) + "): the integral gives " +
                                 certified(i, j).toDecimal(60) + ", the differences " + estimate.toDecimal(60));
      }
    }
  }
}

/// The rotational gradient from the gradient g with respect to the normal: n x g, in flatland (J n).g.
std::vector<Ball> turned(const Eigen::Vector3d& normal, const BallVector& g) {
  const BallVector result = enclosure::cross<Ball>(exactly(normal), g);
  return {result(0), result(1), result(2)};
}
std::vector<Ball> turned(const Eigen::Vector2d& normal, const Eigen::Matrix<Ball, 2, 1>& g) {
  return {Ball(normal(0)) * g(1) - Ball(normal(1)) * g(0)};
}

template <class Enclosure, class Normal>
Json valuesOf(const Enclosure& certified, const Enclosure& estimated, const Normal& normal, const std::string& route) {
  using Single = Eigen::Matrix<Ball, 1, 1>;
  const WorkingPrecision scope(precisionForDigits(300));
  requireAgreement(Single(certified.value), Single(estimated.value), "value");
  requireAgreement(certified.gradient, estimated.gradient, "gradient");
  requireAgreement(certified.hessian, estimated.hessian, "Hessian");
  DecimalPrinter value;
  DecimalPrinter gradient;
  DecimalPrinter hessian;
  Json values;
  values["value"] = value.print(certified.value);
  for (Eigen::Index i = 0; i < certified.gradient.size(); ++i) {
    values["gradient"].push_back(gradient.print(certified.gradient(i)));
    Json row = Json::array();
    for (Eigen::Index j = 0; j < certified.gradient.size(); ++j) row.push_back(hessian.print(certified.hessian(i, j)));
    values["hessian"].push_back(row);
  }
  requireAgreement(certified.normal_gradient, estimated.normal_gradient, "gradient with respect to the normal");
  DecimalPrinter rotational;
  for (const Ball& component : turned(normal, certified.normal_gradient)) {
    values["rotational_gradient"].push_back(rotational.print(component));
  }
  values["error"] = {{"value", value.error()},
                     {"gradient", gradient.error()},
                     {"hessian", hessian.error()},
                     {"rotational_gradient", rotational.error()}};
  values["route"] = route;
  return values;
}

Json evaluate(const ReferenceInput& input) {
  const Polygon polygon{input.name, input.vertices, 1.0};
  const Receiver receiver{input.position, input.normal};
  const FormFactorEnclosure estimated = differenceContour(polygon, receiver);
  try {
    return valuesOf(enclosePolar(polygon, receiver, kProvenDigits), estimated, input.normal, "polar");
  } catch (const std::domain_error&) {
    // In the plane of the polygon there are no polar coordinates, but nothing is singular either.
    return valuesOf(encloseArea(polygon, receiver, kProvenDigits), estimated, input.normal, "area");
  }
}

Json evaluate(const FlatlandReferenceInput& input) {
  const Segment segment{input.name, input.vertices, 1.0};
  const FlatlandReceiver receiver{input.position, input.normal};
  return valuesOf(encloseFlatland(segment, receiver, kProvenDigits), differenceFlatland(segment, receiver),
                  input.normal, "line");
}

template <class Input>
void writeFamily(const ReferenceFamily<Input>& family, int dimension, const std::filesystem::path& folder) {
  Json document;
  document["format"] = "irradiff-reference";
  document["version"] = 1;
  document["dimension"] = dimension;
  document["family"] = family.name;
  document["cases"] = Json::array();
  for (const Input& input : family.inputs) {
    const auto start = std::chrono::steady_clock::now();
    Json item;
    item["name"] = input.name;
    item["reason"] = input.reason;
    for (const auto& vertex : input.vertices) item["vertices"].push_back(hexFloats(vertex));
    item["position"] = hexFloats(input.position);
    item["normal"] = hexFloats(input.normal);
    try {
      item.update(evaluate(input));
    } catch (const std::exception& error) {
      throw std::runtime_error(family.name + "/" + input.name + ": " + error.what());
    }
    document["cases"].push_back(item);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    std::cerr << family.name << "/" << input.name << ": " << elapsed.count() << " s\n";
  }
  const std::filesystem::path file = folder / (family.name + ".json");
  const std::filesystem::path aside = file.string() + ".new";
  std::ofstream stream(aside);
  stream << document.dump(1) << "\n";
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + aside.string());
  std::filesystem::rename(aside, file);
}

int run(const std::string& only, const std::filesystem::path& folder) {
  bool found = false;
  const auto wanted = [&](const std::string& name) {
    const bool is_wanted = only.empty() || only == name;
    found = found || is_wanted;
    return is_wanted;
  };
  std::filesystem::create_directories(folder);
  for (const auto& families : {regularFamilies(), singularFamilies(), horizonFamilies()}) {
    for (const PolygonFamily& family : families) {
      if (wanted(family.name)) writeFamily(family, 3, folder);
    }
  }
  const FlatlandFamily flatland = flatlandFamily();
  if (wanted(flatland.name)) writeFamily(flatland, 2, folder);
  if (found) return 0;
  std::cerr << "generate_reference: there is no family \"" << only << "\"\n";
  return 2;
}

}  // namespace

}  // namespace irradiff

int main(int argument_count, char** arguments) {
  std::string only;
  std::string output;
  for (int i = 1; i + 1 < argument_count; i += 2) {
    const std::string option = arguments[i];
    if (option == "--only") only = arguments[i + 1];
    if (option == "--output") output = arguments[i + 1];
  }
  const int expected = 1 + 2 * (only.empty() ? 0 : 1) + 2 * (output.empty() ? 0 : 1);
  if (output.empty() || argument_count != expected) {
    std::cerr << "usage: generate_reference [--only FAMILY] --output DIR\n";
    return 2;
  }
  try {
    return irradiff::run(only, output);
  } catch (const std::exception& error) {
    std::cerr << "generate_reference: " << error.what() << "\n";
    return 1;
  }
}
