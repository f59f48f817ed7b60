#include "verification/certified/certified_sums.h"

#include "derivatives/boundary/boundary_sums.h"
#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/horizon_clip.h"
#include "derivatives/visibility/boundary_of_view.h"
#include "derivatives/visibility/lifted_vector.h"
#include "derivatives/visibility/view_unit.h"
#include "verification/certified/arc_moment_bounds.h"
#include "verification/certified/ball_rounding.h"

#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace irradiff {

namespace {

/// What horizonHeight promises where it sums without error, rounded up (derivatives/scene/exact_sum.h).
constexpr double kExactHeightError = 0x1p-100;

template <class WideScalar>
WideScalar exactDifference(double a, double b) {
  if constexpr (std::same_as<WideScalar, Ball>) {
    Ball difference;
    const Ball minuend(a);
    const Ball subtrahend(b);
    arb_sub(difference.get(), minuend.get(), subtrahend.get(), ARF_PREC_EXACT);
    return difference;
  } else {
    return WideScalar(twoDifference(a, b));
  }
}

template <class WideScalar>
Vector3<WideScalar> exactDifference(const Vector3<double>& a, const Vector3<double>& b) {
  Vector3<WideScalar> difference;
  for (int i = 0; i < 3; ++i) difference(i) = exactDifference<WideScalar>(a(i), b(i));
  return difference;
}

/// The height of a vertex over the horizon, of certain sign.
template <class WideScalar>
WideScalar certainHeight(const Vector3<double>& vertex, const Vector3<WideScalar>& relative,
                         const Vector3<double>& position, const Vector3<double>& normal) {
  if constexpr (std::same_as<WideScalar, Ball>) {
    // A sum of products of doubles is a number of finitely many bits.
    Ball height;
    for (int i = 0; i < 3; ++i) {
      const Ball factor(normal(i));
      arb_addmul(height.get(), factor.get(), relative(i).get(), ARF_PREC_EXACT);
    }
    return height;
  } else {
    const WideScalar height = dot(lifted<WideScalar>(normal), relative);
    // So certain that it still is when it is rounded to the scalar.
    if (std::abs(static_cast<double>(height.value())) > 2.0 * height.error()) return height;
    const auto exact = horizonHeight<DoubleWord<double>>(vertex, position, normal);
    return {exact, kExactHeightError * std::abs(exact.hi)};
  }
}

using Machine = RunningBound<long double>;
using Words = RunningBound<DoubleWord<double>>;

/// Irradiance and rotational gradient once more, with angles in long double: they are sums of angles of either sign,
/// and cancel to a hundredth of their terms in every tenth generic polygon, where the other derivatives do not.
void replaceAngleSums(const ClippedPolygon<RunningBound<double>, Words>& polygon, const Vector3<double>& normal,
                      IrradianceDerivatives<RunningBound<double>>& derivatives) {
  const Vector3<Words> wide_normal = lifted<Words>(normal);
  const Machine length = norm(lifted<Machine>(normal));
  Machine irradiance(0.0);
  Vector3<Machine> rotational = Vector3<Machine>::Constant(Machine(0.0));
  for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
    const auto& start = polygon.vertices[i];
    const auto& end = polygon.vertices[(i + 1) % polygon.vertices.size()];
    const Vector3<Words> moment = cross(start.position, difference(end.position, start.position));
    const auto along_normal = static_cast<Machine>(dot(wide_normal, moment));
    const Machine area = norm(narrow<Machine>(moment));
    const Machine cosine_product = dot(narrow<Machine>(start.position), narrow<Machine>(end.position));
    if (!(start.height > RunningBound<double>(0.0)) && !(end.height > RunningBound<double>(0.0))) {
      irradiance += withSignOf(length * atan2(area, cosine_product), along_normal);
      continue;
    }
    if (!isPositive(area)) continue;
    const Machine factor = atan2(area, cosine_product) / area;
    irradiance += factor * along_normal;
    const Vector3<Machine> turned = narrow<Machine>(cross(wide_normal, moment));
    for (int k = 0; k < 3; ++k) rotational(k) += factor * turned(k);
  }
  const Machine half(0.5);
  derivatives.irradiance.value = static_cast<RunningBound<double>>(half * irradiance);
  for (int k = 0; k < 3; ++k) {
    derivatives.rotational_gradient.value(k) = static_cast<RunningBound<double>>(half * rotational(k));
  }
}

template <class Scalar>
DerivativeBounds sizesOf(const BoundarySums<Scalar>& sums) {
  return {sizeOf(sums.irradiance_size), sizeOf(sums.gradient_size), sizeOf(sums.hessian_size),
          sizeOf(sums.tangential_size), sizeOf(sums.rotational_size)};
}

}  // namespace

template <class Scalar>
CertifiedSums<Scalar> polygonSums(const PreparedPolygon& prepared, const Receiver& receiver) {
  using WideScalar = Wide<Scalar>;
  const ScaledPolygon& polygon = prepared.scaled;
  std::vector<ClippedVertex<Scalar, WideScalar>> loop;
  std::vector<WideScalar> heights;
  loop.reserve(polygon.vertices.size());
  heights.reserve(polygon.vertices.size());
  for (const Vector3<double>& vertex : polygon.vertices) {
    Vector3<WideScalar> relative = exactDifference<WideScalar>(vertex, polygon.position);
    heights.push_back(certainHeight(vertex, relative, polygon.position, receiver.normal));
    loop.push_back({std::move(relative), static_cast<Scalar>(heights.back())});
  }
  const auto clipped = clipAtHorizon<Scalar, WideScalar>(std::move(loop), std::span<const WideScalar>(heights));
  const Vector3<Scalar> normal = lifted<Scalar>(receiver.normal);
  const BoundarySums<Scalar> sums = boundarySums(polygonBoundary(clipped, normal), normal);
  CertifiedSums<Scalar> result{sums.derivatives, sizesOf(sums), polygon.exponent};
  if constexpr (std::same_as<Scalar, RunningBound<double>>) {
    replaceAngleSums(clipped, receiver.normal, result.derivatives);
  }
  return result;
}

template <class Scalar>
CertifiedSums<Scalar> viewSums(const SceneMesh& mesh, const SceneComposition& scene, const Receiver& receiver) {
  const ViewUnit unit = viewUnit(mesh, scene.view, scene.partly_hidden, receiver);
  const Vector3<Scalar> normal = lifted<Scalar>(receiver.normal);
  const BoundaryOfView<Scalar> of_view = boundaryOfView<Scalar>(mesh, scene.view, scene.partly_hidden,
                                                                lifted<Scalar>(unit.position), normal, unit.exponent);
  const BoundarySums<Scalar> sums = boundarySums(of_view.boundary, normal);
  CertifiedSums<Scalar> result{sums.derivatives, sizesOf(sums), mesh.exponent() + unit.exponent};
  for (const ApparentVertexTerm<Scalar>& term : of_view.vertex_terms) {
    const Matrix2<Scalar> tangential = tangentialHessian(term.hessian, normal).value;
    Matrix3<Scalar>& hessian = result.derivatives.hessian.value;
    Matrix2<Scalar>& tangential_sum = result.derivatives.tangential_hessian.value;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) hessian(i, j) = hessian(i, j) + term.hessian(i, j);
    }
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) tangential_sum(i, j) = tangential_sum(i, j) + tangential(i, j);
    }
    result.sizes.hessian += sizeOf(term.size);
    result.sizes.tangential_hessian += sizeOf(term.size);
  }
  return result;
}

template CertifiedSums<RunningBound<double>> polygonSums(const PreparedPolygon&, const Receiver&);
template CertifiedSums<Words> polygonSums(const PreparedPolygon&, const Receiver&);
template CertifiedSums<Ball> polygonSums(const PreparedPolygon&, const Receiver&);
template CertifiedSums<Machine> viewSums(const SceneMesh&, const SceneComposition&, const Receiver&);
template CertifiedSums<Words> viewSums(const SceneMesh&, const SceneComposition&, const Receiver&);
template CertifiedSums<Ball> viewSums(const SceneMesh&, const SceneComposition&, const Receiver&);

}  // namespace irradiff
