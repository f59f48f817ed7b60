#include "experiments/cache_2d/flatland_records.h"

#include "derivatives/error_metric/error_metric.h"
#include "derivatives/scene/number_text.h"
#include "experiments/cache_2d/flatland_reprojection.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace irradiff {
namespace {

constexpr std::string_view kOracle = "oracle";
constexpr std::string_view kReprojection = "reprojection";
/// At how many distances on either side irradiance is predicted.
constexpr std::size_t kPredictions = 12;
/// Limits of the half-length in pixels are short by this share: a record of one pixel would else serve the receivers
/// beside it, alone and with next to no weight, where rounding puts them less than a pixel away.
constexpr double kShortPixel = 1e-9;

void requireSearch(const MetricChoice& choice) {
  const std::string text = "error metric " + choice.metric + ": ";
  if (!(choice.threshold > 0.0) || std::isinf(choice.threshold)) {
    throw std::invalid_argument(text + "the threshold is " + numberText(choice.threshold) + ", must be finite and > 0");
  }
  if (!(choice.smallest_pixels > 0.0 && choice.largest_pixels >= choice.smallest_pixels &&
        std::isfinite(choice.smallest_pixels))) {
    throw std::invalid_argument(text + "the limits of the radius are " + numberText(choice.smallest_pixels) + " and " +
                                numberText(choice.largest_pixels) +
                                " pixels, must be 0 < smallest <= largest, the smallest finite");
  }
}

double pixelOf(const WallReceiver& receiver) { return receiver.cell_length * (1.0 - kShortPixel); }

ErrorMetric publishedMetric(const MetricChoice& choice, double pixel_size) {
  return ErrorMetric(choice.metric, {choice.threshold, choice.ellipse, choice.smallest_pixels * pixel_size,
                                     choice.largest_pixels * pixel_size});
}

}  // namespace

FlatlandRecords::FlatlandRecords(std::shared_ptr<const WallReceivers> walls)
    : walls_(std::move(walls)), gathers_(walls_->receivers.size()), predictions_(walls_->receivers.size()) {}

void FlatlandRecords::gatherAt(const LitRoom& room, std::size_t receiver) {
  const WallReceiver& place = walls_->receivers[receiver];
  gathers_[receiver] = gather(room, place.side, place.position);
  predictions_[receiver] = {predictedErrors(room, receiver, false), predictedErrors(room, receiver, true)};
}

Receiver FlatlandRecords::receiver(std::size_t receiver) const {
  const WallReceiver& place = walls_->receivers[receiver];
  const Eigen::Vector2d& normal = walls_->sides[place.side].normal;
  return {{place.position.x(), place.position.y(), 0.0}, {normal.x(), normal.y(), 0.0}};
}

SideError FlatlandRecords::predictedErrors(const LitRoom& room, std::size_t receiver, bool is_after) const {
  const WallReceiver& place = walls_->receivers[receiver];
  const FlatlandGather& gathered = gathers_[receiver];
  const std::vector<std::size_t>& line = walls_->lines[place.line];
  const WallReceiver& end = walls_->receivers[is_after ? line.back() : line.front()];
  const double reach = std::abs(end.along_line - place.along_line);
  const double shortest = std::min(reach, 2.0 * place.cell_length);
  const std::size_t count = reach == shortest ? (reach > 0.0 ? 1 : 0) : kPredictions;
  const FlatlandReprojection view(room, place.side, place.position);
  SideError error;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = count == 1 ? 1.0 : static_cast<double>(i) / static_cast<double>(count - 1);
    const double distance = shortest * std::pow(reach / shortest, share);
    const double step = is_after ? distance : -distance;
    error.distances.push_back(distance);
    error.errors.push_back(std::abs(view.irradiance(step) - (gathered.irradiance + gathered.gradient.x() * step)));
  }
  // The cell of the last receiver.
  error.distances.push_back(reach + 0.5 * end.cell_length);
  error.errors.push_back(count == 0 ? 0.0 : error.errors.back());
  return error;
}

SideError FlatlandRecords::trueErrors(std::size_t receiver, bool is_after) const {
  const WallReceiver& place = walls_->receivers[receiver];
  const FlatlandGather& gathered = gathers_[receiver];
  const std::vector<std::size_t>& line = walls_->lines[place.line];
  SideError result;
  double covered = 0.5 * place.cell_length;
  double last_error = 0.0;
  const auto add = [&result](double distance, double error) {
    result.distances.push_back(distance);
    result.errors.push_back(error);
  };
  for (std::size_t rank = place.rank; is_after ? ++rank < line.size() : rank-- > 0;) {
    const WallReceiver& other = walls_->receivers[line[rank]];
    const double step = other.along_line - place.along_line;
    const double distance = std::abs(step);
    const double error =
        std::abs(gathers_[line[rank]].irradiance - (gathered.irradiance + gathered.gradient.x() * step));
    // Nothing is wrong where there is no receiver.
    if (const double begin = distance - 0.5 * other.cell_length; begin > covered + 1e-6 * other.cell_length) {
      add(covered, last_error);
      add(covered, 0.0);
      add(begin, 0.0);
      add(begin, error);
    }
    add(distance, error);
    covered = distance + 0.5 * other.cell_length;
    last_error = error;
  }
  add(covered, last_error);
  return result;
}

double FlatlandRecords::hessianLength(std::size_t receiver, const MetricChoice& choice) const {
  const FlatlandGather& g = gathers_[receiver];
  const bool is_black = g.irradiance == 0.0;
  // As RecordEstimator: a share of the mean radiance E/2 more on all that is seen, or radiance 1 where all is black.
  const double added = is_black ? 1.0 : 0.5 * choice.radiance_share * g.irradiance;
  FlatlandRecordDerivatives record;
  record.irradiance = {is_black ? g.unit_irradiance : g.irradiance};
  record.tangential_gradient = g.gradient.x();
  record.harmonic_mean_distance = g.harmonic_mean_distance;
  if (choice.metric == "radiometric-hessian") {
    record.tangential_hessian = g.unaware_hessian + added * g.unit_unaware_hessian;
  } else if (choice.metric == "geometric-hessian") {
    record.tangential_hessian = (0.5 * g.irradiance + added) * g.kernel_curvature;
  } else {
    record.tangential_hessian = g.hessian + added * g.unit_hessian;
  }
  return publishedMetric(choice, pixelOf(walls_->receivers[receiver])).halfLength(record);
}

double FlatlandRecords::searchedLength(std::size_t receiver, const MetricChoice& choice) const {
  const bool is_oracle = choice.metric == kOracle;
  const SideError before = is_oracle ? trueErrors(receiver, false) : predictions_[receiver][0];
  const SideError after = is_oracle ? trueErrors(receiver, true) : predictions_[receiver][1];
  const bool is_relative = choice.ellipse.scale == ErrorScale::kRelative;
  const double threshold = choice.threshold * (is_relative ? gathers_[receiver].irradiance : 1.0);
  const double pixel = pixelOf(walls_->receivers[receiver]);
  return std::clamp(intervalOfError(before, after, threshold, choice.ellipse.measure), choice.smallest_pixels * pixel,
                    choice.largest_pixels * pixel);
}

double FlatlandRecords::trueError(std::size_t receiver, double half_length) const {
  return integratedError(trueErrors(receiver, false), trueErrors(receiver, true), half_length);
}

double FlatlandRecords::halfLength(std::size_t receiver, const MetricChoice& choice) const {
  const bool is_searched = choice.metric == kOracle || choice.metric == kReprojection;
  const double length = is_searched ? searchedLength(receiver, choice) : hessianLength(receiver, choice);
  if (choice.metric == kOracle || gathers_[receiver].irradiance > 0.0) return length;
  return std::min(length, std::max(choice.smallest_pixels, choice.black_pixels) * pixelOf(walls_->receivers[receiver]));
}

std::vector<std::string> FlatlandRecords::metrics() {
  std::vector<std::string> names;
  for (const ErrorMetricDescription& metric : errorMetricDescriptions()) names.emplace_back(metric.name);
  names.emplace_back(kReprojection);
  names.emplace_back(kOracle);
  return names;
}

RecordMaker FlatlandRecords::maker(std::shared_ptr<const FlatlandRecords> records, const MetricChoice& choice) {
  const std::vector<std::string> known = metrics();
  if (std::ranges::find(known, choice.metric) == known.end()) {
    std::string names;
    for (const std::string& name : known) names += (names.empty() ? " " : ", ") + name;
    throw std::invalid_argument("unknown error metric \"" + choice.metric + "\": must be one of" + names);
  }
  if (!(choice.radiance_share >= 0.0) || std::isinf(choice.radiance_share)) {
    throw std::invalid_argument("the share of the mean radiance that is added for an error metric is " +
                                numberText(choice.radiance_share) + ", must be finite and >= 0");
  }
  choice.ellipse.require();
  if (choice.metric == kOracle || choice.metric == kReprojection) {
    requireSearch(choice);
  } else {
    publishedMetric(choice, 1.0);
  }
  return [records = std::move(records), choice](std::size_t index) {
    const FlatlandGather& gathered = records->gatherOf(index);
    const WallSide& side = records->walls_->sides[records->walls_->receivers[index].side];
    const auto inSpace = [](const Eigen::Vector2d& v) { return Eigen::Vector3d(v.x(), v.y(), 0.0); };
    CacheRecord record;
    record.receiver = records->receiver(index);
    record.irradiance = gathered.irradiance;
    record.gradient = inSpace(gathered.gradient.x() * side.tangent + gathered.gradient.y() * side.normal);
    record.rotational_gradient = {0.0, 0.0, gathered.turn};
    record.first_axis = inSpace(side.tangent);
    record.second_axis = Eigen::Vector3d::UnitZ();
    record.half_axes.setConstant(records->halfLength(index, choice));
    return record;
  };
}

}  // namespace irradiff
