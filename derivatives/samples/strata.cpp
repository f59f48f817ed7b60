#include "derivatives/samples/strata.h"

#include "derivatives/samples/concentric_strata.h"
#include "derivatives/samples/hemicube_strata.h"
#include "derivatives/samples/polar_strata.h"

#include <numbers>
#include <stdexcept>
#include <string>

namespace irradiff {

namespace {

void requireShape(Stratification stratification, const GridShape& shape) {
  const auto refuse = [&shape](const std::string& rule) {
    throw std::invalid_argument("shape " + std::to_string(shape.rows) + " x " + std::to_string(shape.columns) + ": " +
                                rule);
  };
  const auto isInRange = [](std::size_t count) { return count >= 1 && count <= kMostStrataInLine; };
  if (!isInRange(shape.rows) || !isInRange(shape.columns)) {
    refuse("must have from 1 to " + std::to_string(kMostStrataInLine) + " rows and columns");
  }
  if (stratification != Stratification::kHemicube) return;
  if (shape.columns % 2 != 0 || shape.rows != 3 * shape.columns) {
    refuse("must be 3 n rows by n columns with n even for a hemicube of resolution n");
  }
}

}  // namespace

Strata::Strata(Stratification stratification, GridShape shape) : stratification_(stratification), shape_(shape) {
  requireShape(stratification, shape);
}

Eigen::Vector3d Strata::direction(const StratumPosition& position) const {
  switch (stratification_) {
    case Stratification::kPolar:
      return polarDirection(shape_, position);
    case Stratification::kConcentric:
      return concentricDirection(shape_, position);
    case Stratification::kHemicube:
      break;
  }
  return hemicubeDirection(shape_, position);
}

StratumPosition Strata::position(const Eigen::Vector3d& direction) const {
  switch (stratification_) {
    case Stratification::kPolar:
      return polarPosition(shape_, direction);
    case Stratification::kConcentric:
      return concentricPosition(shape_, direction);
    case Stratification::kHemicube:
      break;
  }
  return hemicubePosition(shape_, direction);
}

StratumPosition Strata::nearestPosition(std::size_t row, std::size_t column, const Eigen::Vector3d& direction) const {
  switch (stratification_) {
    case Stratification::kPolar:
      return polarNearestPosition(shape_, row, column, direction);
    case Stratification::kConcentric:
      return concentricNearestPosition(shape_, row, column, direction);
    case Stratification::kHemicube:
      break;
  }
  return hemicubeNearestPosition(shape_, row, column, direction);
}

double Strata::projectedSolidAngle(std::size_t row, std::size_t column) const {
  if (stratification_ == Stratification::kHemicube) return hemicubeProjectedSolidAngle(shape_, row, column);
  return std::numbers::pi / static_cast<double>(shape_.size());
}

double Strata::solidAngle(std::size_t row, std::size_t column) const {
  switch (stratification_) {
    case Stratification::kPolar:
      return polarSolidAngle(shape_, row);
    case Stratification::kConcentric:
      return concentricSolidAngle(shape_, row, column);
    case Stratification::kHemicube:
      break;
  }
  return hemicubeSolidAngle(shape_, row, column);
}

}  // namespace irradiff
