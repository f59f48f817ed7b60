#pragma once

#include <Eigen/Core>

namespace irradiff {

/// The normals that are within an angle of a record's own: those of the receivers that it may serve.
class NormalCone {
 public:
  /// `degrees` between 0 and 180, inclusive. Throws std::invalid_argument naming the angle otherwise.
  static NormalCone ofDegrees(double degrees);

  /// Whether the angle between two unit vectors is at most that of the cone. By the length of their difference, 2
  /// sin(angle/2): the cosine of an angle below 1e-8 is 1.
  bool contains(const Eigen::Vector3d& normal, const Eigen::Vector3d& other) const {
    return (normal - other).norm() <= longest_difference_;
  }

 private:
  explicit NormalCone(double longest_difference) : longest_difference_(longest_difference) {}

  double longest_difference_;
};

}  // namespace irradiff
