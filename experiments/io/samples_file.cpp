#include "experiments/io/samples_file.h"

#include "derivatives/samples/strata.h"
#include "derivatives/scene/number_text.h"
#include "experiments/io/json_fields.h"
#include "experiments/io/json_text.h"
#include "experiments/io/scene_fields.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace irradiff {

namespace {

constexpr std::string_view kFormat = "irradiff-samples";
constexpr int kVersion = 1;

constexpr std::array kStratifications = {Stratification::kConcentric, Stratification::kPolar,
                                         Stratification::kHemicube};

void requireHeader(const JsonField& file) {
  requireFormat(file, kFormat);
  wholeNumberOf(file, "version", {kVersion}, std::to_string(kVersion));
  if (file.has("description")) file.at("description").text();
}

Eigen::Vector3d readUnitVector(const JsonField& field) {
  Eigen::Vector3d vector = vectorOf<3>(field);
  const double length = vector.stableNorm();
  if (!(std::abs(length - 1.0) <= kFrameTolerance)) {
    field.refuse(pointText(vector) + " has length " + numberText(length) + ", must be 1 within " +
                 numberText(kFrameTolerance));
  }
  return vector;
}

SampleFrame readFrame(const JsonField& file) {
  SampleFrame frame;
  frame.position = vectorOf<3>(file.at("position"));
  frame.normal = readUnitVector(file.at("normal"));
  frame.tangent = readUnitVector(file.at("tangent"));
  frame.bitangent = readUnitVector(file.at("bitangent"));
  const auto requireOrthogonal = [](std::string_view name, const Eigen::Vector3d& v, std::string_view other_name,
                                    const Eigen::Vector3d& w) {
    const double product = v.dot(w);
    if (std::abs(product) <= kFrameTolerance) return;
    throw SceneFileError(std::string(name) + ": " + pointText(v) + " and " + std::string(other_name) + " " +
                         pointText(w) + " have the dot product " + numberText(product) + ", must be 0 within " +
                         numberText(kFrameTolerance));
  };
  requireOrthogonal("tangent", frame.tangent, "normal", frame.normal);
  requireOrthogonal("bitangent", frame.bitangent, "normal", frame.normal);
  requireOrthogonal("tangent", frame.tangent, "bitangent", frame.bitangent);
  if (frame.tangent.cross(frame.bitangent).dot(frame.normal) < 0.0) {
    throw SceneFileError("bitangent: " + pointText(frame.bitangent) + " makes a left-handed frame with tangent " +
                         pointText(frame.tangent) + " and normal " + pointText(frame.normal) +
                         ", must be normal x tangent");
  }
  return frame;
}

Strata readStrata(const JsonField& file) {
  const JsonField name = file.at("stratification");
  const auto* const found = std::ranges::find(kStratifications, name.text(), nameOf);
  if (found == kStratifications.end()) {
    name.refuse("expected \"concentric\", \"polar\" or \"hemicube\", got \"" + name.text().substr(0, 60) + "\"");
  }
  const JsonField shape = file.at("shape");
  if (shape.size() != 2) shape.refuse("expected 2 whole numbers, got " + std::to_string(shape.size()));
  const GridShape grid{shape.at(std::size_t{0}).positiveInteger(), shape.at(std::size_t{1}).positiveInteger()};
  try {
    return {*found, grid};
  } catch (const std::invalid_argument& error) {
    throw SceneFileError(error.what());
  }
}

void requireCount(const JsonField& field, std::size_t count, const GridShape& shape) {
  field.size();  // an array at all
  if (count == shape.size()) return;
  field.refuse("has " + std::to_string(count) + " entries, must have " + std::to_string(shape.size()) +
               ", one for each stratum of shape " + std::to_string(shape.rows) + " x " + std::to_string(shape.columns));
}

/// One sample: its place among the others and what was written of it.
struct WrittenSample {
  std::size_t index;
  Eigen::Vector3d hit;
  double radiance;

  bool isMiss() const { return std::isnan(hit.x()); }
  [[noreturn]] void refuseHit(const std::string& reason) const {
    throw SceneFileError("hits[" + std::to_string(index) + "]: " + pointText(hit) + " " + reason);
  }
};

double checkedRadiance(const WrittenSample& sample) {
  const auto refuse = [&sample](const std::string& reason) {
    throw SceneFileError("radiance[" + std::to_string(sample.index) + "]: " + reason);
  };
  if (std::isnan(sample.radiance)) {
    if (!sample.isMiss()) refuse("is null, must be given where a ray hit something");
    return 0.0;
  }
  if (sample.radiance < 0.0) refuse("is " + numberText(sample.radiance) + ", must be >= 0");
  return sample.radiance;
}

struct SeenHit {
  Eigen::Vector3d direction;
  double inverse_distance;
};

SeenHit seenHit(const WrittenSample& sample, const SampleFrame& frame, const Strata& strata) {
  const std::size_t columns = strata.shape().columns;
  const std::size_t row = sample.index / columns;
  const std::size_t column = sample.index % columns;
  if (sample.isMiss()) return {strata.direction({row, column}), 0.0};

  const Eigen::Vector3d offset = sample.hit - frame.position;
  const double distance = offset.stableNorm();
  if (!std::isfinite(distance))
    sample.refuseHit("is farther away than a double holds; a ray that hits nothing has null");
  const double inverse_distance = 1.0 / distance;
  if (!std::isfinite(inverse_distance)) {
    sample.refuseHit("is at the position " + pointText(frame.position) + ", must be elsewhere");
  }
  // Scaled first: squares of a small distance's components underflow.
  const Eigen::Vector3d toward = offset / offset.cwiseAbs().maxCoeff();
  Eigen::Vector3d direction = (frame.axes().transpose() * toward).normalized();
  const double tolerance = directionTolerance(frame.position, sample.hit);
  if (direction.z() < 0.0) {
    if (direction.z() < -tolerance) {
      sample.refuseHit("is below the horizon: its height over the tangent plane is " + numberText(direction.z()) +
                       " of its distance, must be >= 0 within " + numberText(tolerance));
    }
    direction.z() = 0.0;
    direction.normalize();
  }
  const double outside = (strata.direction(strata.nearestPosition(row, column, direction)) - direction).norm();
  if (outside > tolerance) {
    const StratumPosition found = strata.position(direction);
    sample.refuseHit("is outside its stratum (row " + std::to_string(row) + ", column " + std::to_string(column) +
                     ") by " + numberText(outside) + ", in row " + std::to_string(found.row) + ", column " +
                     std::to_string(found.column) + ": must be inside within " + numberText(tolerance));
  }
  return {direction, inverse_distance};
}

HemisphereSamples samplesOf(SamplesRecord record) {
  const JsonField file = JsonField::whole(record.fields, "samples");
  requireHeader(file);
  file.requireFields({"format", "version", "description", "position", "normal", "tangent", "bitangent",
                      "stratification", "shape", "hits", "radiance"});
  const Strata strata = readStrata(file);
  HemisphereSamples samples;
  samples.frame = readFrame(file);
  samples.stratification = strata.stratification();
  samples.shape = strata.shape();
  const std::size_t count = samples.shape.size();
  requireCount(file.at("hits"), record.hit_x.size(), samples.shape);
  requireCount(file.at("radiance"), record.radiance.size(), samples.shape);

  // Hits become directions in their place: of many samples there is no second copy.
  samples.direction_t = std::move(record.hit_x);
  samples.direction_b = std::move(record.hit_y);
  samples.direction_n = std::move(record.hit_z);
  samples.radiance = std::move(record.radiance);
  samples.inverse_distance.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const WrittenSample written{k, samples.direction(k), samples.radiance[k]};
    samples.radiance[k] = checkedRadiance(written);
    const SeenHit seen = seenHit(written, samples.frame, strata);
    samples.direction_t[k] = seen.direction.x();
    samples.direction_b[k] = seen.direction.y();
    samples.direction_n[k] = seen.direction.z();
    samples.inverse_distance[k] = seen.inverse_distance;
  }
  return samples;
}

std::string vectorText(const Eigen::Vector3d& vector, std::string_view field) {
  std::string text = "[";
  for (const double component : vector) text += (text.size() > 1 ? "," : "") + jsonNumber(component, field);
  return text + "]";
}

/// An array with a row of strata a line.
template <class ElementText>
void writeRows(std::ostream& stream, const GridShape& shape, ElementText elementText) {
  stream << '[';
  for (std::size_t k = 0; k < shape.size(); ++k) {
    if (k > 0) stream << ',';
    if (k % shape.columns == 0) stream << "\n  ";
    stream << elementText(k);
  }
  stream << ']';
}

}  // namespace

double directionTolerance(const Eigen::Vector3d& position, const Eigen::Vector3d& hit) {
  constexpr double kSingleRoundoff = 0x1p-24;
  const double coordinates = position.cwiseAbs().maxCoeff() + hit.cwiseAbs().maxCoeff();
  const double from_coordinates = std::sqrt(3.0) * coordinates / (hit - position).stableNorm();
  return std::min(2.0 * kSingleRoundoff * (3.0 + from_coordinates), 1.0 / 64.0);
}

std::optional<HemisphereSamples> SamplesReader::next() {
  std::optional<SamplesRecord> record = records_.next();
  if (!record) return std::nullopt;
  return samplesOf(*std::move(record));
}

void writeSamples(std::ostream& stream, const HemisphereSamples& samples, std::string_view description) {
  const SampleFrame& frame = samples.frame;
  stream << "{\"format\": \"" << kFormat << "\", \"version\": " << kVersion << ",\n";
  if (!description.empty()) {
    stream << " \"description\": "
           << nlohmann::json(description).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << ",\n";
  }
  stream << " \"position\": " << vectorText(frame.position, "position")
         << ", \"normal\": " << vectorText(frame.normal, "normal")
         << ",\n \"tangent\": " << vectorText(frame.tangent, "tangent")
         << ", \"bitangent\": " << vectorText(frame.bitangent, "bitangent") << ",\n \"stratification\": \""
         << nameOf(samples.stratification) << "\", \"shape\": [" << samples.shape.rows << ',' << samples.shape.columns
         << "],\n \"hits\": ";
  const Eigen::Matrix3d axes = frame.axes();
  writeRows(stream, samples.shape, [&](std::size_t k) -> std::string {
    if (samples.inverse_distance[k] == 0.0) return "null";
    return vectorText(frame.position + axes * (samples.direction(k) / samples.inverse_distance[k]),
                      "hits[" + std::to_string(k) + "]");
  });
  stream << ",\n \"radiance\": ";
  writeRows(stream, samples.shape,
            [&](std::size_t k) { return jsonNumber(samples.radiance[k], "radiance[" + std::to_string(k) + "]"); });
  stream << "\n}\n";
}

}  // namespace irradiff
