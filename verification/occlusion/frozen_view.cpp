#include "verification/occlusion/frozen_view.h"

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/visibility/boundary_of_view.h"

#include <ceres/jet.h>

namespace irradiff {

FrozenView::FrozenView(const OccludedScene& scene)
    : scene_(scene), evaluator_(scene.polygons), view_(evaluator_.view(scene.receiver)) {
  for (const Polygon& polygon : scene_.polygons) radiances_.push_back(polygon.radiance);
}

template <class Scalar>
Scalar FrozenView::irradianceAt(const Vector3<Scalar>& position) const {
  const Scalar scale = lift<Scalar>(std::ldexp(1.0, -evaluator_.mesh().exponent()));
  Vector3<Scalar> normal;
  for (int i = 0; i < 3; ++i) normal(i) = lift<Scalar>(scene_.receiver.normal(i));
  const RadianceBoundary<Scalar> boundary =
      boundaryOfView<Scalar>(evaluator_.mesh(), view_, radiances_, scaled(position, scale), normal).boundary;
  // 1/2 sum dL n.Gamma
  Scalar sum = boundary.horizon_angle;
  for (const BoundaryArc<Scalar>& arc : boundary.arcs) {
    sum = sum + arc.radiance_jump * arc.angle * dot(normal, arc.plane_normal);
  }
  return lift<Scalar>(0.5) * sum;
}

Multiprecision FrozenView::irradiance(const MultiprecisionVector& position) const { return irradianceAt(position); }

FrozenView::Derivatives FrozenView::differentiated() const {
  using First = ceres::Jet<Multiprecision, 3>;
  using Second = ceres::Jet<First, 3>;
  Vector3<Second> position;
  for (int i = 0; i < 3; ++i) {
    position(i) = Second(First(Multiprecision(scene_.receiver.position(i)), i));
    position(i).v[i] = First(Multiprecision(1));
  }
  const Second irradiance = irradianceAt(position);
  Derivatives result;
  result.irradiance = irradiance.a.a;
  for (int i = 0; i < 3; ++i) {
    result.gradient(i) = irradiance.v[i].a;
    for (int j = 0; j < 3; ++j) result.hessian(i, j) = irradiance.v[i].v[j];
  }
  return result;
}

IrradianceDerivatives<Multiprecision> FrozenView::formulas() const {
  const int exponent = evaluator_.mesh().exponent();
  const MultiprecisionVector normal = withoutRounding(scene_.receiver.normal);
  const MultiprecisionVector position =
      withoutRounding(scene_.receiver.position) * Multiprecision(std::ldexp(1.0, -exponent));
  const BoundaryOfView<Multiprecision> of_view =
      boundaryOfView<Multiprecision>(evaluator_.mesh(), view_, radiances_, position, normal);
  IrradianceDerivatives<Multiprecision> d = boundarySums(of_view.boundary, normal).derivatives;
  for (const ApparentVertexTerm<Multiprecision>& term : of_view.vertex_terms) {
    d.hessian.value += term.hessian;
    d.tangential_hessian.value += tangentialHessian(term.hessian, normal).value;
  }
  const Multiprecision scale(std::ldexp(1.0, -exponent));
  d.gradient.value *= scale;
  d.hessian.value *= Multiprecision(scale * scale);
  d.tangential_hessian.value *= Multiprecision(scale * scale);
  return d;
}

}  // namespace irradiff
