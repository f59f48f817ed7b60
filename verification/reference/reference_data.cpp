#include "verification/reference/reference_data.h"

#include <mpfr.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace irradiff {

namespace {

using Json = nlohmann::json;

constexpr mpfr_prec_t kDecimalPrecision = 256;  // bits: more than 60 digits

/// A place in a file, for messages.
struct Place {
  std::string file;
  std::string item;

  [[noreturn]] void reject(const std::string& what) const { throw InvalidReference(file + ": " + item + ": " + what); }
};

const Json& field(const Json& object, const char* name, const Place& place) {
  if (!object.is_object() || !object.contains(name)) place.reject("field \"" + std::string(name) + "\" is missing");
  return object.at(name);
}

std::string text(const Json& object, const char* name, const Place& place) {
  const Json& member = field(object, name, place);
  if (!member.is_string())
    place.reject("field \"" + std::string(name) + "\" is " + member.dump() + "; it must be a string");
  return member.get<std::string>();
}

double hexFloat(const Json& member, const Place& place) {
  if (!member.is_string()) place.reject(member.dump() + " must be a string with a hexadecimal float");
  const auto digits = member.get<std::string>();
  char* end = nullptr;
  const double value = std::strtod(digits.c_str(), &end);
  if (digits.find("0x") == std::string::npos || *end != '\0' || !std::isfinite(value)) {
    place.reject("\"" + digits + "\" is not a finite hexadecimal float");
  }
  return value;
}

ReferenceNumber decimal(const Json& member, const Place& place) {
  if (!member.is_string()) place.reject(member.dump() + " must be a string with a decimal number");
  ReferenceNumber number;
  number.decimal = member.get<std::string>();
  mpfr_t parsed;
  mpfr_init2(parsed, kDecimalPrecision);
  const bool is_number = mpfr_set_str(parsed, number.decimal.c_str(), 10, MPFR_RNDN) == 0 && mpfr_number_p(parsed) != 0;
  if (is_number) {
    number.high = mpfr_get_d(parsed, MPFR_RNDN);
    mpfr_sub_d(parsed, parsed, number.high, MPFR_RNDN);
    number.low = mpfr_get_d(parsed, MPFR_RNDN);
  }
  mpfr_clear(parsed);
  if (!is_number || !std::isfinite(number.high))
    place.reject("\"" + number.decimal + "\" is not a decimal number a double can hold");
  return number;
}

const Json& listOf(const Json& member, std::size_t size, const std::string& name, const Place& place) {
  if (!member.is_array() || member.size() != size) {
    place.reject(name + " is " + member.dump() + "; it must be a list of " + std::to_string(size));
  }
  return member;
}

template <int Dimension>
Eigen::Matrix<double, Dimension, 1> point(const Json& member, const Place& place) {
  listOf(member, Dimension, "a point", place);
  Eigen::Matrix<double, Dimension, 1> result;
  for (Eigen::Index k = 0; k < Dimension; ++k) result(k) = hexFloat(member[static_cast<std::size_t>(k)], place);
  return result;
}

template <int Dimension>
void readValues(ReferenceValues& values, ReceiverIn<Dimension>& receiver, const Json& item, const Place& place) {
  values.reason = text(item, "reason", place);
  values.route = text(item, "route", place);
  receiver.position = point<Dimension>(field(item, "position", place), place);
  receiver.normal = point<Dimension>(field(item, "normal", place), place);
  validate(receiver, 0);
  values.value = decimal(field(item, "value", place), place);
  values.gradient.resize(Dimension);
  values.hessian.resize(Dimension, Dimension);
  const Json& gradient = listOf(field(item, "gradient", place), Dimension, "gradient", place);
  const Json& hessian = listOf(field(item, "hessian", place), Dimension, "hessian", place);
  for (Eigen::Index i = 0; i < Dimension; ++i) {
    const auto row = static_cast<std::size_t>(i);
    values.gradient(i) = decimal(gradient[row], place);
    listOf(hessian[row], Dimension, "a row of the Hessian", place);
    for (Eigen::Index j = 0; j < Dimension; ++j) {
      values.hessian(i, j) = decimal(hessian[row][static_cast<std::size_t>(j)], place);
    }
  }
  constexpr std::size_t kTurns = Dimension == 3 ? 3 : 1;
  values.rotational_gradient.resize(kTurns);
  const Json& rotational = listOf(field(item, "rotational_gradient", place), kTurns, "rotational_gradient", place);
  for (std::size_t i = 0; i < kTurns; ++i) {
    values.rotational_gradient(static_cast<Eigen::Index>(i)) = decimal(rotational[i], place);
  }
  const Json& error = field(item, "error", place);
  values.error = {text(error, "value", place), text(error, "gradient", place), text(error, "hessian", place),
                  text(error, "rotational_gradient", place)};
  for (const std::string& bound :
       {values.error.value, values.error.gradient, values.error.hessian, values.error.rotational_gradient})
    decimal(Json(bound), place);
}

void readShape(ReferenceCase& reference, const Json& item, const Place& place) {
  const Json& vertices = field(item, "vertices", place);
  if (!vertices.is_array() || vertices.size() < 3) place.reject("vertices must be a list of at least 3 points");
  for (const Json& vertex : vertices) reference.polygon.vertices.push_back(point<3>(vertex, place));
  reference.polygon.name = reference.name;
  reference.polygon.radiance = 1.0;
}

void readShape(FlatlandReferenceCase& reference, const Json& item, const Place& place) {
  const Json& vertices = listOf(field(item, "vertices", place), 2, "vertices", place);
  for (std::size_t i = 0; i < 2; ++i) reference.segment.vertices[i] = point<2>(vertices[i], place);
  reference.segment.name = reference.name;
  reference.segment.radiance = 1.0;
}

Json readDocument(const std::filesystem::path& file) {
  const Place place{file.filename().string(), "document"};
  std::ifstream stream(file);
  if (!stream) place.reject("cannot be opened");
  Json document = Json::parse(stream, nullptr, false);
  if (document.is_discarded()) place.reject("is not JSON");
  if (text(document, "format", place) != "irradiff-reference") place.reject("format must be \"irradiff-reference\"");
  if (field(document, "version", place) != 1) place.reject("version must be 1");
  return document;
}

template <class Case>
constexpr int kDimension = std::is_same_v<Case, ReferenceCase> ? 3 : 2;

template <class Case>
std::vector<Case> casesOf(const Json& document, const std::string& file) {
  Place place{file, "document"};
  const std::string family = text(document, "family", place);
  const Json& items = field(document, "cases", place);
  if (!items.is_array()) place.reject("cases must be a list");
  std::vector<Case> cases;
  for (const Json& item : items) {
    place.item = "case " + std::to_string(cases.size());
    Case reference;
    reference.family = family;
    reference.name = text(item, "name", place);
    place.item += " \"" + reference.name + "\"";
    try {
      readShape(reference, item, place);
      readValues<kDimension<Case>>(reference, reference.receiver, item, place);
    } catch (const std::invalid_argument& error) {
      place.reject(error.what());
    }
    cases.push_back(std::move(reference));
  }
  return cases;
}

template <class Case>
std::vector<Case> readFile(const std::filesystem::path& path) {
  const std::string file = path.filename().string();
  const Json document = readDocument(path);
  const Place place{file, "document"};
  if (field(document, "dimension", place) != kDimension<Case>) {
    place.reject("dimension must be " + std::to_string(kDimension<Case>));
  }
  return casesOf<Case>(document, file);
}

template <class Case>
std::vector<Case> readFolder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Case> cases;
  for (const std::filesystem::path& file : files) {
    const Json document = readDocument(file);
    const std::string name = file.filename().string();
    if (field(document, "dimension", {name, "document"}) != kDimension<Case>) continue;
    std::vector<Case> more = casesOf<Case>(document, name);
    std::move(more.begin(), more.end(), std::back_inserter(cases));
  }
  if (cases.empty())
    throw InvalidReference("folder \"" + folder.string() + "\" has no reference cases of dimension " +
                           std::to_string(kDimension<Case>));
  return cases;
}

}  // namespace

std::vector<ReferenceCase> readReferenceFile(const std::filesystem::path& file) {
  return readFile<ReferenceCase>(file);
}

std::vector<FlatlandReferenceCase> readFlatlandReferenceFile(const std::filesystem::path& file) {
  return readFile<FlatlandReferenceCase>(file);
}

std::vector<ReferenceCase> readReferenceData(const std::filesystem::path& folder) {
  return readFolder<ReferenceCase>(folder);
}

std::vector<FlatlandReferenceCase> readFlatlandReferenceData(const std::filesystem::path& folder) {
  return readFolder<FlatlandReferenceCase>(folder);
}

}  // namespace irradiff
