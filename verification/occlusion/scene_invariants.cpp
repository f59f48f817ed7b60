#include "verification/occlusion/scene_invariants.h"

#include "derivatives/scene/invalid_scene.h"
#include "verification/checks/verdict_builder.h"
#include "verification/occlusion/scene_mistakes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace irradiff {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

double maxNorm(const MatrixXd& m) { return m.size() == 0 ? 0.0 : m.cwiseAbs().maxCoeff(); }

double largestRadiance(const OccludedScene& scene) {
  double largest = 0.0;
  for (const Polygon& polygon : scene.polygons) largest = std::max(largest, polygon.radiance);
  return largest;
}

/// Applies `map` to every vertex and the receiver's position.
template <class Map>
OccludedScene mapped(OccludedScene scene, const Map& map) {
  for (Polygon& polygon : scene.polygons) {
    for (Vector3d& v : polygon.vertices) v = map(v);
  }
  scene.receiver.position = map(scene.receiver.position);
  return scene;
}

bool isValid(const OccludedScene& scene) {
  try {
    for (std::size_t i = 0; i < scene.polygons.size(); ++i) validate(scene.polygons[i], i);
    return true;
  } catch (const InvalidScene&) {
    return false;
  }
}

/// The scene and another one, of which a law says how the results are related.
struct Pair {
  OccludedScene original;
  OccludedScene changed;
};

/// The difference of two results in units of what is allowed.
double excess(const MatrixXd& expected, const MatrixXd& actual, double bound, double tolerance) {
  const double difference = maxNorm(actual - expected);
  if (difference == 0.0) return 0.0;
  const double allowed = bound > 0.0 ? bound : tolerance * std::max(maxNorm(expected), maxNorm(actual));
  return difference / allowed;
}

/// One law: pairs of scenes, and what the result of the first makes expect for the second. `is_exact` where no digit
/// may change.
template <class MakePair, class Expect>
std::vector<Verdict> checkLaw(const SceneCandidate& candidate, const std::string& law, const SceneFamily& family,
                              const OcclusionOptions& options, bool is_exact, const MakePair& makePair,
                              const Expect& expect) {
  const std::string rule = is_exact ? "no bit may change" : "in units of the sum of both bounds, or of the tolerance";
  std::vector<VerdictBuilder> builders;
  builders.reserve(kSceneQuantities.size());
  for (const Quantity quantity : kSceneQuantities) {
    builders.emplace_back(candidate.name, law, std::string(family.name), quantity, is_exact ? 0.0 : 1.0, rule);
  }
  for (std::size_t i = 0; i < options.scenes; ++i) {
    KeyedRandom random(options.seed, law, i);
    const std::optional<Pair> pair = makePair(drawScene(family, options.seed, i), random);
    if (!pair) continue;
    builders.front().attempt(pair->changed, [&] {
      const SceneResult before = candidate.evaluate(pair->original);
      const SceneResult after = candidate.evaluate(pair->changed);
      for (std::size_t q = 0; q < kSceneQuantities.size(); ++q) {
        const Quantity quantity = kSceneQuantities[q];
        const std::optional<MatrixXd> value = before.get(quantity);
        const std::optional<MatrixXd> actual = after.get(quantity);
        if (!value || !actual) continue;
        const MatrixXd expected = expect(quantity, *value);
        const double bound =
            before.bounds && after.bounds ? boundOf(*before.bounds, quantity) + boundOf(*after.bounds, quantity) : 0.0;
        builders[q].add(is_exact ? maxNorm(*actual - expected) : excess(expected, *actual, bound, options.tolerance),
                        0.0, pair->changed, expected, *actual);
      }
    });
  }
  std::vector<Verdict> verdicts;
  for (const VerdictBuilder& builder : builders) {
    if (Verdict verdict = builder.finish(); verdict.inputs > 0) verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

MatrixXd same(Quantity, const MatrixXd& value) { return value; }

Vector3d permuted(const Vector3d& v) { return {v(1), v(2), v(0)}; }

std::optional<Pair> quarterTurned(const OccludedScene& scene, KeyedRandom&) {
  Pair pair{scene, mapped(scene, permuted)};
  pair.changed.receiver.normal = permuted(scene.receiver.normal);
  return pair;
}

MatrixXd permutedValue(Quantity quantity, const MatrixXd& value) {
  MatrixXd result = value;
  for (Eigen::Index i = 0; i < value.rows() && quantity != Quantity::kIrradiance; ++i) {
    for (Eigen::Index j = 0; j < value.cols(); ++j) {
      result(i, j) = value((i + 1) % 3, quantity == Quantity::kHessian ? (j + 1) % 3 : 0);
    }
  }
  return result;
}

constexpr int kLengthExponent = 37;

std::optional<Pair> scaledByPowerOfTwo(const OccludedScene& scene, KeyedRandom&) {
  return Pair{scene, mapped(scene, [](const Vector3d& v) { return Vector3d(std::ldexp(1.0, kLengthExponent) * v); })};
}

MatrixXd scaledValue(Quantity quantity, const MatrixXd& value) {
  const int order = quantity == Quantity::kHessian ? 2 : quantity == Quantity::kGradient ? 1 : 0;
  return std::ldexp(1.0, -kLengthExponent * order) * value;
}

Polygon smallTriangle(const Vector3d& centre, const Vector3d& normal, double size, KeyedRandom& random) {
  const Vector3d u = normal.cross(random.direction()).normalized();
  const Vector3d v = normal.cross(u).normalized();
  return {"unseen", {centre + size * u, centre - size * u + size * v, centre - 0.5 * size * u - size * v}, 0.0};
}

/// Below the horizon: along -n, and smaller than its depth.
Polygon triangleBelow(const OccludedScene& scene, KeyedRandom& random) {
  const double extent = extentOf(scene);
  const Vector3d down = (random.between(0.0, 0.5) * random.direction() - scene.receiver.normal).normalized();
  return smallTriangle(scene.receiver.position + 0.5 * extent * down, random.direction(), 0.05 * extent, random);
}

/// Behind a triangle of the scene, in directions that are well within it; whatever else is there may hide it too.
std::optional<Polygon> triangleBehind(const OccludedScene& scene, KeyedRandom& random) {
  const Vector3d& x = scene.receiver.position;
  const Polygon& screen = scene.polygons[random.below(scene.polygons.size())];
  if (screen.vertices.size() != 3) return std::nullopt;
  const Vector3d centre = (screen.vertices[0] + screen.vertices[1] + screen.vertices[2]) / 3.0;
  const auto shrunk = [&](const Vector3d& v) { return Vector3d(x + 3.0 * (centre + 0.1 * (v - centre) - x)); };
  return Polygon{"unseen", {shrunk(screen.vertices[0]), shrunk(screen.vertices[1]), shrunk(screen.vertices[2])}, 0.0};
}

/// In a direction where there is nothing, as cones about the polygons tell.
std::optional<Polygon> triangleAside(const OccludedScene& scene, KeyedRandom& random) {
  const Vector3d& x = scene.receiver.position;
  const double extent = extentOf(scene);
  const auto angleBetween = [](const Vector3d& a, const Vector3d& b) {
    return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
  };
  for (int attempt = 0; attempt < 20; ++attempt) {
    const Vector3d w = random.direction();
    if (w.dot(scene.receiver.normal) < 0.2) continue;
    const bool is_empty = std::ranges::all_of(scene.polygons, [&](const Polygon& polygon) {
      Vector3d axis = Vector3d::Zero();
      for (const Vector3d& v : polygon.vertices) axis += (v - x).normalized();
      axis.normalize();
      double widest = 0.0;
      for (const Vector3d& v : polygon.vertices) widest = std::max(widest, angleBetween(axis, (v - x).normalized()));
      return widest < 1.2 && angleBetween(axis, w) > widest + 0.1;
    });
    if (is_empty) return smallTriangle(x + random.between(0.05, 1.0) * extent * w, w, 1e-3 * extent, random);
  }
  return std::nullopt;
}

/// A black triangle where it changes nothing, appended.
std::optional<Pair> withUnseenPolygon(const OccludedScene& scene, KeyedRandom& random) {
  std::optional<Polygon> unseen;
  const std::size_t kind = random.below(3);
  if (kind == 1) unseen = triangleBehind(scene, random);
  if (kind == 2) unseen = triangleAside(scene, random);
  if (!unseen) unseen = triangleBelow(scene, random);
  Pair pair{scene, scene};
  pair.changed.polygons.push_back(*unseen);
  return pair;
}

/// The first three vertices of every polygon, on a grid of 2^-24 of the scene's size; one of the triangles in halves.
std::optional<Pair> withSplitPolygon(const OccludedScene& scene, KeyedRandom& random) {
  const double grid = std::ldexp(1.0, std::ilogb(extentOf(scene)) - 24);
  Pair pair{scene, scene};
  for (Polygon& polygon : pair.original.polygons) {
    polygon.vertices.resize(3);
    for (Vector3d& v : polygon.vertices) v = (v / grid).array().round() * grid;
  }
  pair.changed = pair.original;
  const std::size_t split = random.below(scene.polygons.size());
  Polygon& half = pair.changed.polygons[split];
  Polygon other = half;
  const Vector3d middle = 0.5 * (half.vertices[0] + half.vertices[1]);
  half.vertices[1] = middle;
  other.vertices[0] = middle;
  pair.changed.polygons.push_back(other);
  return isValid(pair.original) && isValid(pair.changed) ? std::optional<Pair>(pair) : std::nullopt;
}

Verdict checkEnergy(const SceneCandidate& candidate, const SceneFamily& family, const OcclusionOptions& options) {
  VerdictBuilder builder(candidate.name, "energy", std::string(family.name), Quantity::kIrradiance, options.tolerance,
                         "share by which irradiance exceeds pi times the largest radiance");
  for (std::size_t i = 0; i < options.scenes; ++i) {
    const OccludedScene scene = drawScene(family, options.seed, i);
    builder.attempt(scene, [&] {
      const double most = std::numbers::pi * largestRadiance(scene);
      const double irradiance = candidate.evaluate(scene).irradiance;
      const double error =
          std::isnan(irradiance) ? irradiance : std::max({0.0, irradiance / most - 1.0, -irradiance / most});
      builder.add(error, 0.0, scene, MatrixXd::Constant(1, 1, most), MatrixXd::Constant(1, 1, irradiance));
    });
  }
  return builder.finish();
}

}  // namespace

std::vector<Verdict> checkSceneInvariants(const SceneCandidate& candidate, const SceneFamily& family,
                                          const OcclusionOptions& options) {
  std::vector<Verdict> verdicts{checkEnergy(candidate, family, options)};
  const auto append = [&verdicts](const std::vector<Verdict>& more) {
    verdicts.insert(verdicts.end(), more.begin(), more.end());
  };
  append(checkLaw(candidate, "quarter turn", family, options, false, quarterTurned, permutedValue));
  append(checkLaw(candidate, "unit of length", family, options, true, scaledByPowerOfTwo, scaledValue));
  append(checkLaw(candidate, "unseen polygon", family, options, true, withUnseenPolygon, same));
  append(checkLaw(candidate, "split polygon", family, options, false, withSplitPolygon, same));
  return verdicts;
}

std::vector<Verdict> checkConstantRooms(const SceneCandidate& candidate, const OcclusionOptions& options) {
  constexpr double kRadiance = 3.0;
  std::vector<VerdictBuilder> builders;
  builders.reserve(kSceneQuantities.size());
  for (const Quantity quantity : kSceneQuantities) {
    builders.emplace_back(candidate.name, "constant radiance", "rooms", quantity, 1.0,
                          "in units of the claimed bound, or of the tolerance times irradiance over powers of the "
                          "distance to the nearest vertex");
  }
  for (std::size_t i = 0; i < options.scenes; ++i) {
    OccludedScene scene = drawScene(sceneFamily("rooms"), options.seed, i);
    double nearest = extentOf(scene);
    for (Polygon& polygon : scene.polygons) {
      polygon.radiance = kRadiance;
      for (const Vector3d& v : polygon.vertices) nearest = std::min(nearest, (v - scene.receiver.position).norm());
    }
    builders.front().attempt(scene, [&] {
      const SceneResult result = candidate.evaluate(scene);
      for (std::size_t q = 0; q < kSceneQuantities.size(); ++q) {
        const std::optional<MatrixXd> actual = result.get(kSceneQuantities[q]);
        if (!actual) continue;
        const MatrixXd expected =
            MatrixXd::Constant(actual->rows(), actual->cols(),
                               kSceneQuantities[q] == Quantity::kIrradiance ? std::numbers::pi * kRadiance : 0.0);
        const double allowed =
            result.bounds
                // pi as a double is off by less than an ulp.
                ? boundOf(*result.bounds, kSceneQuantities[q]) + 0x1p-52 * maxNorm(expected)
                : options.tolerance * std::numbers::pi * kRadiance / std::pow(nearest, static_cast<double>(q));
        builders[q].add(maxNorm(*actual - expected) / allowed, 0.0, scene, expected, *actual);
      }
    });
  }
  std::vector<Verdict> verdicts;
  for (const VerdictBuilder& builder : builders) {
    if (Verdict verdict = builder.finish(); verdict.inputs > 0) verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

}  // namespace irradiff
