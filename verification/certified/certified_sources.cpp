#include "verification/certified/certified_sources.h"

#include "verification/certified/certified_sums.h"

#include <cmath>

namespace irradiff {

namespace {

/// `sumAt` is a template over the scalar; Machine is that of the first rung.
template <class Machine, class SumAt>
CertifiedValue<3> valueAt(const LadderStep& step, SumAt sumAt) {
  switch (step.rung) {
    case Rung::kDouble:
      return inMetres(sumAt.template operator()<RunningBound<Machine>>());
    case Rung::kExtended:
      return inMetres(sumAt.template operator()<RunningBound<DoubleWord<double>>>());
    case Rung::kBall:
      break;
  }
  const WorkingPrecision precision(step.bits);
  return inMetres(sumAt.template operator()<Ball>());
}

}  // namespace

CertifiedValue<3> polygonValue(const PreparedPolygon& prepared, const Receiver& receiver, const LadderStep& step) {
  CertifiedValue<3> value =
      valueAt<double>(step, [&]<class Scalar>() { return polygonSums<Scalar>(prepared, receiver); });
  const RunningBound<double>& irradiance = value.rounded.irradiance.value;
  if (irradiance < RunningBound<double>(0.0)) {
    negate(value);
  } else if (!(irradiance > RunningBound<double>(0.0))) {
    CertifiedValue<3> unknown = unknownLight<3>();
    if (step.bits == kMostBits) {
      unknown.rounded.irradiance.value = irradiance;
      for (int i = 0; i < 3; ++i) {
        const RunningBound<double>& either_sign = value.rounded.rotational_gradient.value(i);
        unknown.rounded.rotational_gradient.value(i) = {0.0, std::abs(either_sign.value()) + either_sign.error()};
      }
    }
    return unknown;
  }
  return value;
}

CertifiedValue<3> viewValue(const SceneMesh& mesh, const SceneComposition& scene, const Receiver& receiver,
                            const LadderStep& step) {
  return valueAt<long double>(step, [&]<class Scalar>() { return viewSums<Scalar>(mesh, scene, receiver); });
}

}  // namespace irradiff
