#include "tests/benchmarks/mesh_section.h"

#include "derivatives/estimators/mesh_derivatives.h"
#include "derivatives/estimators/triangulated.h"
#include "derivatives/form_factor/appendix_form.h"
#include "derivatives/samples/sample_hemisphere.h"
#include "derivatives/samples/sample_mesh.h"
#include "derivatives/samples/strata.h"
#include "tests/benchmarks/ratio_reporter.h"
#include "tests/estimators/triangle_sum.h"
#include "verification/checks/random.h"

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iomanip>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace irradiff {

namespace {

constexpr std::uint64_t kSeed = 2012;
constexpr int kRounds = 11;
constexpr std::size_t kRows = 64;

/// The room |x|, |y| <= 1, 0 <= z <= 2 with sides of different radiance, and a black square in it at height 1/2.
RayHit lookIntoRoom(const Eigen::Vector3d& position, const Eigen::Vector3d& w) {
  const std::array<RayHit, 5> sides{{{w.x() / (1.0 - position.x()), 0.9},
                                     {-w.x() / (1.0 + position.x()), 0.3},
                                     {w.y() / (1.0 - position.y()), 0.6},
                                     {-w.y() / (1.0 + position.y()), 0.1},
                                     {w.z() / 2.0, 1.5}}};
  const double at_height = 0.5 / w.z();
  const double x = position.x() + at_height * w.x();
  const double y = position.y() + at_height * w.y();
  if (std::max(std::abs(x), std::abs(y)) <= 0.35) return {1.0 / at_height, 0.0};
  return *std::max_element(sides.begin(), sides.end(),
                           [](const RayHit& a, const RayHit& b) { return a.inverse_distance < b.inverse_distance; });
}

/// Seen from the room's floor.
HemisphereSamples recordOfWalls() {
  const SampleFrame frame{
      {0.31, -0.17, 0.0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  return sampleHemisphere(Strata(Stratification::kConcentric, {kRows, kRows}), SamplePattern::kJittered, kSeed, 0,
                          frame, [&frame](const Eigen::Vector3d& w) { return lookIntoRoom(frame.position, w); });
}

HemisphereSamples withRandomRadiance(HemisphereSamples samples) {
  KeyedRandom random(kSeed, "radiance", 0);
  for (double& radiance : samples.radiance) radiance = random.unit();
  return samples;
}

/// A record, with what a renderer has at hand: the points that rays hit.
struct Record {
  HemisphereSamples samples;
  SampleMesh mesh;
  std::vector<Vector3<double>> hits;

  explicit Record(HemisphereSamples given)
      : samples(std::move(given)), mesh(samples.stratification, samples.shape, MeshRim::kOpen) {
    for (std::size_t i = 0; i < samples.shape.size(); ++i) {
      hits.emplace_back(samples.direction(i) / samples.inverse_distance[i]);
    }
  }

  MeshSamples input() const {
    return {samples.direction_t, samples.direction_b, samples.direction_n, samples.inverse_distance, samples.radiance};
  }

  double farthestRadiance(const std::array<std::size_t, 3>& corners) const {
    std::size_t farthest = corners[0];
    for (const std::size_t corner : corners) {
      if (samples.inverse_distance[corner] < samples.inverse_distance[farthest]) farthest = corner;
    }
    return samples.radiance[farthest];
  }
};

const Vector3<double> kNormal(0.0, 0.0, 1.0);

// Eqs. (9) and (10) as they stand.
MeshDerivatives appendixByTriangles(const Record& record) {
  MeshDerivatives sum{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (const MeshTriangles& run : record.mesh.triangles()) {
    for (std::size_t k = 0; k < run.count; ++k) {
      const std::array corners{run.corners[0] + k, run.corners[1] + k, run.corners[2] + k};
      const std::array triangle{record.hits[corners[0]], record.hits[corners[1]], record.hits[corners[2]]};
      const FormFactor<double> form_factor =
          appendixFormFactor<double>(std::span<const Vector3<double>>(triangle), kNormal, VertexAngle::kArccos);
      const double weight = pi<double>() * record.farthestRadiance(corners);
      sum.gradient += weight * form_factor.gradient;
      sum.hessian += weight * form_factor.hessian;
    }
  }
  return sum;
}

// The same sums once an edge with a jump, Eqs. (20) and (21) with their sign corrected.
MeshDerivatives appendixByEdges(const Record& record) {
  std::vector<double> radiances(record.mesh.triangleCount() + 1, 0.0);
  for (const MeshTriangles& run : record.mesh.triangles()) {
    for (std::size_t k = 0; k < run.count; ++k) {
      radiances[run.first + k] = record.farthestRadiance({run.corners[0] + k, run.corners[1] + k, run.corners[2] + k});
    }
  }
  MeshDerivatives sum{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (const MeshEdges& run : record.mesh.edges()) {
    for (std::size_t k = 0; k < run.count; ++k) {
      const double jump = radiances[run.right + k] - radiances[run.left + k];
      if (jump == 0.0) continue;
      const Vector3<double>& r = record.hits[run.start + k];
      const Vector3<double>& r_next = record.hits[run.end + k];
      const auto [I1, I2, I3, J2, J3, K3] = appendixIntegrals(r, r_next, VertexAngle::kArccos);
      const Vector3<double> e = r_next - r;
      const Vector3<double> n_cross_e = cross(kNormal, e);
      const double n_r_cross = dot(kNormal, cross(r, r_next));
      const Vector3<double> weighted = I2 * r + J2 * e;
      sum.gradient += jump * 0.5 * (I1 * n_cross_e + 2.0 * n_r_cross * weighted);
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          sum.hessian(a, b) +=
              jump * (n_cross_e(a) * weighted(b) + n_cross_e(b) * weighted(a) +
                      4.0 * n_r_cross * (r(a) * r(b) * I3 + e(a) * e(b) * K3 + J3 * (r(a) * e(b) + r(b) * e(a))));
        }
        sum.hessian(a, a) -= jump * n_r_cross * I2;
      }
    }
  }
  return sum;
}

/// Of gradient and tangential Hessian, the larger.
double relativeDifference(const MeshDerivatives& value, const MeshDerivatives& reference) {
  const auto error = [](const auto& a, const auto& b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
  };
  return std::max(error(value.gradient, reference.gradient),
                  error(value.hessian.topLeftCorner<2, 2>().eval(), reference.hessian.topLeftCorner<2, 2>().eval()));
}

/// Of one call, called as often as it takes to fill a hundredth of a second.
template <class Work>
double microseconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  double elapsed = 0.0;
  int calls = 0;
  while (elapsed < 0.01) {
    benchmark::DoNotOptimize(work());
    ++calls;
    elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return 1e6 * elapsed / calls;
}

const char* nameOf(VectorInstructions instructions) {
  switch (instructions) {
    case VectorInstructions::kAvx2:
      return "AVX2";
    case VectorInstructions::kAvx512:
      return "AVX-512";
    default:
      return "plain";
  }
}

/// The sum over triangles with the kernel in angles.
MeshDerivatives sumInAngles(const HemisphereSamples& samples, MeshRim rim) {
  const SampleMesh mesh(samples.stratification, samples.shape, rim);
  const TriangleSum<double> sum = triangleSum(meshVertices<double>(mesh, samples), radiantTriangles(mesh, samples));
  return {sum.gradient, sum.hessian};
}

struct Contender {
  std::string name;
  std::function<MeshDerivatives()> derivatives;
  MeshRim rim = MeshRim::kOpen;
  std::vector<double> times, ratios;
};

/// Ours with the widest instructions first.
std::vector<Contender> contendersFor(const Record& record) {
  std::vector<Contender> contenders;
  const auto add = [&contenders](std::string name, std::function<MeshDerivatives()> derivatives,
                                 MeshRim rim = MeshRim::kOpen) {
    contenders.push_back({std::move(name), std::move(derivatives), rim, {}, {}});
  };
  std::vector<VectorInstructions> widest_first = vectorInstructions();
  std::reverse(widest_first.begin(), widest_first.end());
  for (const VectorInstructions instructions : widest_first) {
    add(std::string("derivatives, ") + nameOf(instructions) + " instructions",
        [&record, instructions] { return meshDerivatives(record.mesh, record.input(), instructions); });
  }
  const auto wholeEstimate = [&record](std::unique_ptr<Estimator> (*make)(Stratification, GridShape)) {
    const std::shared_ptr<Estimator> estimator = make(record.samples.stratification, record.samples.shape);
    return [&record, estimator] {
      const IrradianceEstimate estimate = estimator->estimate(record.samples);
      return MeshDerivatives{*estimate.gradient, *estimate.hessian};
    };
  };
  add("triangulated, irradiance and rotation too", wholeEstimate(makeTriangulated));
  add("triangulated-closed, likewise", wholeEstimate(makeTriangulatedClosed), MeshRim::kDownToHorizon);
  add("appendix form with acos, once an edge", [&record] { return appendixByEdges(record); });
  add("appendix form with acos, by triangles", [&record] { return appendixByTriangles(record); });
  return contenders;
}

void printContenders(std::ostream& out, const Record& record, const std::string& title) {
  std::vector<Contender> contenders = contendersFor(record);
  for (int round = 0; round < kRounds; ++round) {
    for (Contender& contender : contenders) {
      contender.times.push_back(microseconds(contender.derivatives));
      contender.ratios.push_back(contender.times.back() / contenders.front().times.back());
    }
  }
  out << '\n'
      << title << '\n'
      << std::left << std::setw(44) << "what" << std::setw(30) << "microseconds" << std::setw(30)
      << "times the first line's"
      << "from the sum in angles\n";
  for (const Contender& contender : contenders) {
    out << std::setw(44) << contender.name << std::setw(30) << spread(contender.times, 1) << std::setw(30)
        << spread(contender.ratios, 2) << std::scientific << std::setprecision(1)
        << relativeDifference(contender.derivatives(), sumInAngles(record.samples, contender.rim)) << std::defaultfloat
        << '\n';
  }
}

}  // namespace

void printMeshSection(std::ostream& out) {
  const HemisphereSamples walls = recordOfWalls();
  out << "\nMesh over " << kRows << " x " << kRows
      << " samples, gradient and Hessian, median (smallest .. largest) over " << kRounds << " rounds";
  printContenders(out, Record(withRandomRadiance(walls)), "Every sample different (asked: at most 60)");
  printContenders(out, Record(walls), "Walls (asked: at most 40)");
  out << "asked: the appendix form at least 15 times the first line\n" << std::flush;
}

}  // namespace irradiff
