#include "derivatives/estimators/hemicube_texel.h"

#include "derivatives/estimators/strata_sums.h"

namespace irradiff {

namespace {

/// Outward normal of the face that the row `row` of texels is on, in the frame (t, b, n).
Eigen::Vector3d faceNormal(std::size_t row, std::size_t resolution) {
  if (row < resolution) return Eigen::Vector3d::UnitZ();
  const std::size_t face = (row - resolution) / (resolution / 2);
  const double sign = face < 2 ? 1.0 : -1.0;
  return sign * (face % 2 == 0 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY());
}

Eigen::Matrix3d symmetricProduct(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Matrix3d product = a * b.transpose();
  return product + product.transpose();
}

class HemicubeTexel final : public Estimator {
 public:
  HemicubeTexel(Stratification stratification, GridShape shape) : sums_(stratification, shape) {}

  // A patch of area A at p = r w, normal f, adds L A (n.p)(f.p)/|p|^4. With A the texel's area times the square of the
  // depth r f.w, and p moving against the receiver:
  //   gradient  L a (f.w)^2 / r   { 4 (n.w)(f.w) w - (f.w) n - (n.w) f }
  //   Hessian   L a (f.w)^2 / r^2 { Q(n, f) - 4 Q((f.w) n + (n.w) f, w) + (n.w)(f.w) (24 w w^T - 4 I) }
  // Q(a, b) = a b^T + b a^T; for the top face at depth 1 the first is the article's 4 grad cos^4.
  IrradianceEstimate estimate(const HemisphereSamples& samples) const override {
    const std::size_t resolution = samples.shape.columns;
    const double texel_width = 2.0 / static_cast<double>(resolution);
    const Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < samples.shape.size(); ++i) {
      const double inverse_distance = samples.inverse_distance[i];
      if (inverse_distance == 0.0 || samples.radiance[i] == 0.0) continue;
      const Eigen::Vector3d w = samples.direction(i);
      const Eigen::Vector3d face = faceNormal(i / resolution, resolution);
      const double cosine = w.z();
      const double face_cosine = face.dot(w);
      const double weight = samples.radiance[i] * texel_width * texel_width * face_cosine * face_cosine;
      const Eigen::Vector3d slopes = face_cosine * normal + cosine * face;
      gradient += weight * inverse_distance * (4.0 * cosine * face_cosine * w - slopes);
      hessian += weight * inverse_distance * inverse_distance *
                 (symmetricProduct(normal, face) - 4.0 * symmetricProduct(slopes, w) +
                  cosine * face_cosine * (12.0 * symmetricProduct(w, w) - 4.0 * Eigen::Matrix3d::Identity()));
    }
    IrradianceEstimate estimate;
    estimate.irradiance = sums_.irradiance(samples);
    estimate.rotational_gradient = sums_.rotationalGradient(samples);
    estimate.setPositionDerivatives(gradient, hessian);
    return estimate;
  }

 private:
  StrataSums sums_;
};

}  // namespace

std::unique_ptr<Estimator> makeHemicubeTexel(Stratification stratification, GridShape shape) {
  return std::make_unique<HemicubeTexel>(stratification, shape);
}

}  // namespace irradiff
