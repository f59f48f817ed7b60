#include "verification/certified/certified_sources.h"

#include "verification/certified/certified_sums.h"

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
    return unknownLight<3>();
  }
  return value;
}

CertifiedValue<3> viewValue(const SceneMesh& mesh, const SceneComposition& scene, const Receiver& receiver,
                            const LadderStep& step) {
  return valueAt<long double>(step, [&]<class Scalar>() { return viewSums<Scalar>(mesh, scene, receiver); });
}

}  // namespace irradiff
