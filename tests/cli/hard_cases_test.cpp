// Every scene of data/hard_cases keeps what its description promises. The expected values are closed forms, symmetries,
// leading orders and values of data/reference, never results of the program.

#include "tests/cli/program_run.h"
#include "verification/reference/reference_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using std::numbers::pi;

const fs::path kFolder = "data/hard_cases";
constexpr double kUnitRoundoff = 0x1p-53;

double maxNorm(const Json& value) {
  if (value.is_number()) return std::abs(value.get<double>());
  double largest = 0;
  for (const Json& entry : value) largest = std::max(largest, maxNorm(entry));
  return largest;
}

double irradiance(const Json& result) { return result.at("irradiance"); }
double bound(const Json& result, const char* quantity) { return result.at("error_bound").at(quantity); }
/// The bound relative to the quantity: what a user reads as the number of good digits.
double relativeBound(const Json& result, const char* quantity) {
  return bound(result, quantity) / maxNorm(result.at(quantity));
}

/// The smaller and the larger one.
std::pair<double, double> tangentialEigenvalues(const Json& result) {
  const Json& h = result.at("tangential_hessian");
  const double mean = 0.5 * (h[0][0].get<double>() + h[1][1].get<double>());
  const double radius = std::hypot(0.5 * (h[0][0].get<double>() - h[1][1].get<double>()), h[0][1].get<double>());
  return {mean - radius, mean + radius};
}

/// E under the corner of a unit square at distance 1 (configuration B-3 of Howell's catalogue).
const double kUnderUnitSquare = std::atan(1 / std::numbers::sqrt2) / std::numbers::sqrt2;

void expectIrradiance(const Json& result, double expected, double error_of_expected = 0) {
  EXPECT_NEAR(irradiance(result), expected,
              bound(result, "irradiance") + error_of_expected + 2 * kUnitRoundoff * expected);
}

void expectVanishing(const Json& result, const char* quantity) {
  EXPECT_LE(maxNorm(result.at(quantity)), bound(result, quantity)) << quantity;
}

/// The digits that are promised where nothing but the edges' position is hard.
void expectGoodDigits(const Json& result) {
  EXPECT_LE(relativeBound(result, "gradient"), 1e-12);
  EXPECT_LE(relativeBound(result, "hessian"), 1e-12);
}

void expectNull(const Json& result, const std::vector<const char*>& quantities, const std::string& reason) {
  for (const char* quantity : quantities) {
    EXPECT_TRUE(result.at(quantity).is_null()) << quantity;
    const Json& bounds = result.at("error_bound");
    EXPECT_TRUE(!bounds.contains(quantity) || bounds[quantity].is_null()) << quantity;
  }
  EXPECT_THAT(result.value("reason", ""), testing::HasSubstr(reason));
}

void expectUnitSquareAtScale(const Json& result, double unit) {
  expectIrradiance(result, kUnderUnitSquare);
  expectGoodDigits(result);
  // Moving under the square along either side increases E, by symmetry equally.
  EXPECT_GT(result["gradient"][0].get<double>() * unit, 0);
  EXPECT_LT(result["gradient"][0].get<double>() * unit, 1);
  EXPECT_NEAR(result["gradient"][0].get<double>(), result["gradient"][1].get<double>(), 2 * bound(result, "gradient"));
  EXPECT_LE(maxNorm(result["hessian"]) * unit * unit, 1);
}

/// The scene is the reference case of this name in data/reference/winding.json, and its derivatives are right to 1e-13
/// of their norms, E too.
void expectReferenceValues(const Json& result, const std::string& scene_name, const std::string& case_name) {
  const std::vector<ReferenceCase> cases = readReferenceFile("data/reference/winding.json");
  const auto reference =
      std::ranges::find_if(cases, [&case_name](const ReferenceCase& c) { return c.name == case_name; });
  ASSERT_NE(reference, cases.end());
  const Json scene = Json::parse(readFile(kFolder / (scene_name + ".json")));
  std::vector<Eigen::Vector3d> vertices;
  for (const Json& vertex : scene["polygons"][0]["vertices"]) vertices.emplace_back(vertex[0], vertex[1], vertex[2]);
  ASSERT_EQ(vertices, reference->polygon.vertices);
  ASSERT_EQ(scene["points"][0]["position"],
            Json(std::vector<double>(reference->receiver.position.begin(), reference->receiver.position.end())));

  EXPECT_NEAR(irradiance(result), pi * reference->value.high, 1e-13 * irradiance(result));
  double gradient_error = 0;
  double hessian_error = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    gradient_error =
        std::max(gradient_error, std::abs(result["gradient"][k].get<double>() - pi * reference->gradient(i).high));
    for (Eigen::Index j = 0; j < 3; ++j) {
      hessian_error = std::max(hessian_error, std::abs(result["hessian"][k][static_cast<std::size_t>(j)].get<double>() -
                                                       pi * reference->hessian(i, j).high));
    }
  }
  EXPECT_LE(gradient_error, 1e-13 * maxNorm(result["gradient"]));
  EXPECT_LE(hessian_error, 1e-13 * maxNorm(result["hessian"]));
}

using Promise = std::function<void(const Json& results)>;

const std::map<std::string, Promise>& promises() {
  static const std::map<std::string, Promise> kPromises{
      {"radial_edge", [](const Json& r) { expectGoodDigits(r[0]); }},
      {"near_edge",
       [](const Json& r) {
         expectGoodDigits(r[0]);
         // An infinite edge at distance d, half of the plane behind it: |grad E| = n.m' / d with n.m' of order 1.
         EXPECT_GT(maxNorm(r[0]["gradient"]), 1e11);
         EXPECT_LT(maxNorm(r[0]["gradient"]), 1e13);
         EXPECT_GT(maxNorm(r[0]["hessian"]), 1e23);
         EXPECT_LT(maxNorm(r[0]["hessian"]), 1e25);
       }},
      {"near_vertex", [](const Json& r) { expectGoodDigits(r[0]); }},
      {"near_plane",
       [](const Json& r) {
         expectGoodDigits(r[0]);
         EXPECT_GT(relativeBound(r[0], "irradiance"), 1e-6);
         EXPECT_LT(irradiance(r[0]), 1e-12);
       }},
      {"tiny_far_polygon",
       [](const Json& r) {
         // A/d^2, and (n.p)(N.p)/|p|^4 = z^-2 differentiated along z and across.
         expectIrradiance(r[0], 1e-18, 1e-34);
         expectGoodDigits(r[0]);
         EXPECT_NEAR(r[0]["gradient"][2].get<double>(), 2e-21, 2e-21 * 1e-14);
         EXPECT_NEAR(r[0]["hessian"][2][2].get<double>(), 6e-24, 6e-24 * 1e-14);
         EXPECT_NEAR(r[0]["hessian"][0][0].get<double>(), -4e-24, 4e-24 * 1e-14);
       }},
      {"tiny_polygon_cut_at_horizon",
       [](const Json& r) {
         expectGoodDigits(r[0]);
         EXPECT_EQ(r[0]["model"]["horizon"], true);
         // Up to the relative size 1e-6: E = int z dA, dE/dz = -A, d2E/dz2 = the length of the cut, 1e-6 / 3, since the
         // corner is cut at a third of its height.
         EXPECT_NEAR(r[0]["hessian"][2][2].get<double>(), 1e-6 / 3, 1e-6 * 1e-5);
       }},
      {"visible_corner",
       [](const Json& r) {
         expectGoodDigits(r[0]);
         // The corner that is seen is a triangle of height h = 1e-10 and width h: E = int z dA = h^3 / 6.
         EXPECT_NEAR(irradiance(r[0]), 1e-30 / 6, 1e-38);
         EXPECT_NEAR(r[0]["hessian"][2][2].get<double>(), 1e-10, 1e-18);
       }},
      {"sliver",
       [](const Json& r) {
         EXPECT_GT(relativeBound(r[0], "gradient"), 1e-8);
         EXPECT_LT(relativeBound(r[0], "gradient"), 1e-3);
         // Its area is 1e-9, and the kernel z^2/|p|^4 between 0.1 and 0.7.
         EXPECT_GT(irradiance(r[0]), 1e-10);
         EXPECT_LT(irradiance(r[0]), 1e-9);
       }},
      {"huge_polygon",
       [](const Json& r) {
         // What is missing is the sky beyond 1e6 m: between the inscribed disk's pi h^2/R^2 and half of it.
         expectIrradiance(r[0], pi, 1e-12 * pi);
         EXPECT_LT(irradiance(r[0]), pi);
         EXPECT_LE(maxNorm(r[0]["gradient"]), 1e-11);
         EXPECT_LE(maxNorm(r[0]["hessian"]), 1e-11);
       }},
      {"scale_1e150", [](const Json& r) { expectUnitSquareAtScale(r[0], 1e150); }},
      {"scale_1e-150", [](const Json& r) { expectUnitSquareAtScale(r[0], 1e-150); }},
      {"translated_1e6", [](const Json& r) { expectUnitSquareAtScale(r[0], 1); }},
      {"winding_spiral", [](const Json& r) { expectReferenceValues(r[0], "winding_spiral", "spiral"); }},
      {"winding_spiral_cut_at_horizon",
       [](const Json& r) { expectReferenceValues(r[0], "winding_spiral_cut_at_horizon", "spiral_at_horizon"); }},
      {"closed_box",
       [](const Json& r) {
         for (const Json& result : r) {
           expectIrradiance(result, 2 * pi);
           expectVanishing(result, "gradient");
           expectVanishing(result, "hessian");
         }
       }},
      {"own_surface",
       [](const Json& r) {
         // Rounding moves vertices by u; that moves each quantity by u times the sizes of the next derivative, which
         // the bounds are 48 u times. The Hessian's derivative is larger than it by 4 / distance, the distance being
         // 0.75.
         const double moved = bound(r[0], "hessian");
         expectIrradiance(r[0], pi, moved);
         EXPECT_LE(maxNorm(r[0]["gradient"]), bound(r[0], "gradient") + moved);
         EXPECT_LE(maxNorm(r[0]["tangential_hessian"]), 2 * moved);
       }},
      {"wall_on_horizon",
       [](const Json& r) {
         expectNull(r[0], {"hessian"}, "horizon");
         EXPECT_TRUE(r[0]["gradient"].is_array());
         EXPECT_TRUE(r[0]["tangential_hessian"].is_array());
         EXPECT_GT(irradiance(r[0]), 0);
       }},
      {"edge_on",
       [](const Json& r) {
         EXPECT_EQ(irradiance(r[0]), 0);
         expectNull(r[0], {"gradient", "hessian", "tangential_hessian"}, "polygons[0] \"card\" is seen edge-on");
       }},
      {"negative_definite_hessian",
       [](const Json& r) {
         EXPECT_LT(tangentialEigenvalues(r[0]).second, -bound(r[0], "hessian"));
         EXPECT_LE(std::abs(r[0]["gradient"][0].get<double>()), bound(r[0], "gradient"));
         EXPECT_LE(std::abs(r[0]["gradient"][1].get<double>()), bound(r[0], "gradient"));
       }},
      {"indefinite_hessian",
       [](const Json& r) {
         EXPECT_LT(tangentialEigenvalues(r[0]).first, -bound(r[0], "hessian"));
         EXPECT_GT(tangentialEigenvalues(r[0]).second, bound(r[0], "hessian"));
       }},
      {"flatland_closed_room",
       [](const Json& r) {
         expectIrradiance(r[0], 2);
         expectVanishing(r[0], "gradient");
         expectVanishing(r[0], "hessian");
       }},
      {"flatland_end_on_horizon",
       [](const Json& r) {
         // E is the difference of the sines of the ends' angles from the normal.
         expectIrradiance(r[0], 1 - 1 / std::sqrt(5.0));
         expectNull(r[0], {"hessian"}, "horizon");
         EXPECT_TRUE(r[0]["tangential_hessian"].is_array());
       }},
  };
  return kPromises;
}

std::vector<std::string> namesOfFiles() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(kFolder))
    names.push_back(entry.path().stem().string());
  return names;
}

TEST(HardCases, AreAllTested) {
  std::vector<std::string> tested;
  for (const auto& [name, promise] : promises()) tested.push_back(name);
  EXPECT_THAT(namesOfFiles(), testing::UnorderedElementsAreArray(tested));
}

/// Every number is there and finite, and every array has its shape.
void expectShape(const Json& value, const std::vector<std::size_t>& shape, std::size_t level = 0) {
  if (level == shape.size()) {
    ASSERT_TRUE(value.is_number()) << value;
    EXPECT_TRUE(std::isfinite(value.get<double>()));
    return;
  }
  ASSERT_EQ(value.size(), shape[level]) << value;
  for (const Json& entry : value) expectShape(entry, shape, level + 1);
}

class HardCase : public testing::TestWithParam<std::string> {};

TEST_P(HardCase, KeepsItsPromise) {
  const fs::path path = kFolder / (GetParam() + ".json");
  const Json scene = Json::parse(readFile(path));
  EXPECT_FALSE(scene.at("description").get<std::string>().empty());
  const std::size_t dimension = scene.at("dimension");
  for (const std::string method : {"boundary", "appendix"}) {
    if (dimension == 2 && method == "appendix") continue;
    SCOPED_TRACE(method);
    const ProgramRun run = runProgram({"evaluate", path, "--method", method});
    ASSERT_EQ(run.status, 0) << run.messages;
    const Json results = Json::parse(run.output).at("results");
    ASSERT_EQ(results.size(), scene.at("points").size());
    for (const Json& result : results) {
      const std::map<std::string, std::vector<std::size_t>> shapes{
          {"irradiance", {}},
          {"gradient", {dimension}},
          {"hessian", {dimension, dimension}},
          {"tangential_hessian", {dimension - 1, dimension - 1}},
          {"rotational_gradient", {dimension == 3 ? std::size_t{3} : std::size_t{1}}}};
      bool any_null = false;
      for (const auto& [name, shape] : shapes) {
        const Json& value = result.at(name);
        any_null = any_null || value.is_null();
        if (!value.is_null()) expectShape(value, shape);
        if (result["error_bound"].contains(name)) {
          EXPECT_EQ(result["error_bound"][name].is_null(), value.is_null()) << name;
          EXPECT_TRUE(value.is_null() || bound(result, name.c_str()) >= 0) << name;
        }
      }
      EXPECT_EQ(result.contains("reason"), any_null);
      EXPECT_TRUE(method == "appendix" || irradiance(result) >= 0) << result;
    }
    // The appendix form promises a bound, not digits.
    if (method == "boundary") promises().at(GetParam())(results);
  }
}

std::vector<std::string> promisedNames() {
  std::vector<std::string> names;
  for (const auto& [name, promise] : promises()) names.push_back(name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Data, HardCase, testing::ValuesIn(promisedNames()), [](const auto& parameter) {
  std::string name = parameter.param;
  if (const std::size_t minus = name.find('-'); minus != std::string::npos) name.replace(minus, 1, "minus");
  return name;
});

}  // namespace
}  // namespace irradiff
