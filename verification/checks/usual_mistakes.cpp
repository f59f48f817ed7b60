#include "verification/checks/usual_mistakes.h"

#include "derivatives/boundary/edge_arcs.h"
#include "derivatives/boundary/edge_kernel.h"
#include "derivatives/boundary/tangent_plane.h"
#include "verification/checks/library_candidates.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <numbers>
#include <sstream>

namespace irradiff {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// What one edge adds to the quantity of radiance 1, over pi, and the parts of what it adds to the Hessian.
struct EdgeShare {
  MatrixXd value;
  Matrix3d from_moment;  ///< s [e]_x
  Matrix3d from_decay;   ///< (r x e) (4 q)^T
  Matrix3d from_cosine;  ///< -(r x e) (I n)^T
  double angle;
  double length;
  double moment;  ///< |r x e|
};

MatrixXd shareOf(Quantity quantity, const ArcTerms<double>& terms, const Vector3d& normal) {
  switch (quantity) {
    case Quantity::kFormFactor:
    case Quantity::kIrradiance:
      return MatrixXd::Constant(1, 1, 0.5 * normal.dot(terms.angle_vector));
    case Quantity::kGradient:
      return terms.gradient;
    case Quantity::kHessian:
      return terms.hessian;
    case Quantity::kTangentialHessian:
      return tangentialHessian<double>(terms.hessian, normal).value;
    case Quantity::kRotationalGradient:
      return 0.5 * terms.turned_angle_vector;
  }
  return {};
}

/// The edges of a loop of vertices relative to the receiver, in their order; those of the horizon have no share.
std::vector<EdgeShare> sharesOf(Quantity quantity, const ClippedPolygon<double>& loop, const Vector3d& normal) {
  std::vector<EdgeShare> shares;
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    const ClippedVertex<double>& start = loop.vertices[i];
    const ClippedVertex<double>& end = loop.vertices[(i + 1) % loop.vertices.size()];
    if (start.height == 0.0 && end.height == 0.0) {
      continue;
    }
    std::vector<BoundaryArc<double>> arcs;
    appendEdgeArcs(start, end, normal, std::numbers::inv_pi, arcs);
    const Vector3d r = narrow<double>(start.position);
    const Vector3d e = narrow<double>(end.position) - r;
    EdgeShare share{{}, Matrix3d::Zero(), Matrix3d::Zero(), Matrix3d::Zero(), 0.0, e.norm(), r.cross(e).norm()};
    for (const BoundaryArc<double>& arc : arcs) {
      const ArcTerms<double> terms = arcTerms(arc, normal);
      const MatrixXd value = arc.radiance_jump * shareOf(quantity, terms, normal);
      share.value = share.value.size() == 0 ? value : MatrixXd(share.value + value);
      share.angle += arc.angle;
      const Vector3d line =
          arc.edge_direction * (arc.angle_over_foot_distance * terms.gradient_size / std::max(arc.angle, 1e-300));
      Matrix3d moment;
      moment << 0.0, -line(2), line(1), line(2), 0.0, -line(0), -line(1), line(0), 0.0;
      const Matrix3d decay = arc.angle * arc.plane_normal * terms.along_line.transpose();
      share.from_moment += arc.radiance_jump * moment;
      share.from_decay += arc.radiance_jump * decay;
      share.from_cosine += arc.radiance_jump * (terms.hessian - moment - decay);
    }
    shares.push_back(std::move(share));
  }
  return shares;
}

/// The loop as it is, nothing cut at the horizon.
ClippedPolygon<double> uncut(const Configuration& c) {
  ClippedPolygon<double> loop;
  for (const Vector3d& vertex : c.polygon.vertices) {
    loop.vertices.push_back({wideDifference<Wide<double>>(vertex, c.receiver.position),
                             c.receiver.normal.dot(vertex - c.receiver.position)});
  }
  return loop;
}

MatrixXd symmetrised(const MatrixXd& m) { return m.rows() == m.cols() ? MatrixXd(0.5 * (m + m.transpose())) : m; }

/// The sum over all edges, nothing cut at the horizon.
MatrixXd uncutSum(Quantity quantity, const Configuration& c) {
  MatrixXd sum;
  for (const EdgeShare& share : sharesOf(quantity, uncut(c), c.receiver.normal)) {
    sum = sum.size() == 0 ? symmetrised(share.value) : MatrixXd(sum + symmetrised(share.value));
  }
  return sum;
}

std::string edgeName(std::size_t edge, std::size_t edges) {
  if (edge + 1 == edges) {
    return "the last edge, back to the first vertex,";
  }
  return "edge " + std::to_string(edge) + ", from vertex " + std::to_string(edge) + " to " + std::to_string(edge + 1) +
         ",";
}

void addMistake(std::vector<UsualMistake>& mistakes, const std::string& text, const MatrixXd& value) {
  const UsualMistake mistake{text, value};
  mistakes.push_back(mistake);
}

/// Adds a mistake that changes the right value by `change`, made before or after the Hessian was made symmetric.
void addChange(std::vector<UsualMistake>& mistakes, const MatrixXd& expected, const std::string& text,
               const MatrixXd& change) {
  addMistake(mistakes, text, expected + change);
  if (change.rows() == change.cols() && change.rows() > 1) {
    addMistake(mistakes, text, expected + symmetrised(change));
  }
}

void addEdgeMistakes(Quantity quantity, const Configuration& c, const MatrixXd& expected,
                     std::vector<UsualMistake>& mistakes) {
  const std::vector<EdgeShare> shares = sharesOf(
      quantity,
      clipAtHorizon<double>(std::span<const Vector3d>(c.polygon.vertices), c.receiver.position, c.receiver.normal),
      c.receiver.normal);
  if (shares.empty()) {
    return;
  }
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const std::string edge = edgeName(i, shares.size());
    addChange(mistakes, expected, edge + " is left out", -shares[i].value);
    addChange(mistakes, expected, edge + " is counted twice", shares[i].value);
    addChange(mistakes, expected, edge + " has the wrong sign", -2.0 * shares[i].value);
  }
  if (quantity == Quantity::kHessian) {
    Matrix3d moment = Matrix3d::Zero();
    Matrix3d decay = moment;
    Matrix3d cosine = moment;
    for (const EdgeShare& share : shares) {
      moment += share.from_moment;
      decay += share.from_decay;
      cosine += share.from_cosine;
    }
    addChange(mistakes, expected, "the term s [e]_x is left out: the derivative of r x e (product rule)", -moment);
    addChange(mistakes, expected, "the term s [e]_x has the wrong sign", -2.0 * moment);
    addChange(mistakes, expected, "the term (r x e) (4 q)^T is left out: the derivative of 1/|p|^4", -decay);
    addChange(mistakes, expected, "the term (r x e) (4 q)^T has the wrong sign", -2.0 * decay);
    addChange(mistakes, expected, "the term (r x e) (I n)^T is left out: the derivative of n.p", -cosine);
    addChange(mistakes, expected, "the term (r x e) (I n)^T has the wrong sign", -2.0 * cosine);
  }
  const auto reweighted = [&](const std::string& text, const std::function<double(const EdgeShare&)>& weight) {
    MatrixXd change = MatrixXd::Zero(expected.rows(), expected.cols());
    for (const EdgeShare& share : shares) {
      change += (weight(share) - 1.0) * share.value;
    }
    addChange(mistakes, expected, text, change);
  };
  reweighted("the edge vector is normalised where its length should count",
             [](const EdgeShare& s) { return 1.0 / s.length; });
  reweighted("an edge's length too much: its vector should be normalised, or the integral run over t in [0, 1]",
             [](const EdgeShare& s) { return s.length; });
  reweighted("r x e, or r x r', is not normalised", [](const EdgeShare& s) { return s.moment; });
  reweighted("r x e is normalised where its length should count", [](const EdgeShare& s) { return 1.0 / s.moment; });
  reweighted("the edge's angle is left out: |Gamma| is the angle between r and r', not 1",
             [](const EdgeShare& s) { return 1.0 / s.angle; });
  reweighted("the sine of the edge's angle for the angle: |r x r'|/(|r||r'|) without asin",
             [](const EdgeShare& s) { return std::sin(s.angle) / s.angle; });
  reweighted("the edge's angle in degrees, where radians are meant",
             [](const EdgeShare&) { return 180.0 / std::numbers::pi; });
}

const char* signText(Quantity quantity) {
  switch (quantity) {
    case Quantity::kGradient:
      return "the sign is flipped: vertices taken counterclockwise, r = x - v for v - x, a derivative with respect to "
             "the polygon's position instead of the receiver's, or Eq. (20) of the 2012 paper as printed";
    case Quantity::kHessian:
    case Quantity::kTangentialHessian:
      return "the sign is flipped: vertices taken counterclockwise, or Eq. (21) of the 2012 paper as printed";
    case Quantity::kRotationalGradient:
      return "the sign is flipped: vertices taken counterclockwise, or V x n for n x V";
    case Quantity::kFormFactor:
    case Quantity::kIrradiance:
      break;
  }
  return "the sign is flipped: vertices taken counterclockwise, or a normal that points away";
}

/// The quantity at another configuration: what is obtained when something is put in wrongly.
void addWrongInputs(Quantity quantity, const Configuration& c, std::vector<UsualMistake>& mistakes) {
  static const Candidate right = productionCandidate();
  const auto add = [&](const std::string& text, const Configuration& wrong) {
    try {
      // A vertex less may leave edges that cross.
      validate(wrong.polygon, 0);
      validate(wrong.receiver, 0);
      addMistake(mistakes, text, right.evaluate(quantity, wrong));
    } catch (const std::exception&) {
      // The library refuses that input, so whoever got a value did something else.
    }
  };
  // Whoever puts vertices in wrong places may well not cut them at the horizon.
  const auto addPlace = [&](const std::string& text, const Vector3d& position) {
    Configuration wrong = c;
    wrong.receiver.position = position;
    add(text, wrong);
    addMistake(mistakes, text, uncutSum(quantity, wrong));
  };
  addPlace("vertices in world coordinates: the receiver's position is not subtracted", Vector3d::Zero());
  addPlace("the receiver's position is added to the vertices instead of subtracted", -c.receiver.position);
  Configuration wrong = c;
  wrong.receiver.normal = Vector3d::UnitZ();
  add("the normal is taken to be (0, 0, 1)", wrong);
  wrong.receiver.normal = Vector3d::UnitY();
  add("the normal is taken to be (0, 1, 0)", wrong);
  for (std::size_t i = 0; i < c.polygon.vertices.size() && c.polygon.vertices.size() > 3; ++i) {
    wrong = c;
    wrong.polygon.vertices.erase(wrong.polygon.vertices.begin() + static_cast<std::ptrdiff_t>(i));
    const bool is_last = i + 1 == c.polygon.vertices.size();
    add(is_last ? "the last vertex is left out" : "vertex " + std::to_string(i) + " is left out", wrong);
  }
  wrong = c;
  wrong.polygon.vertices.resize(3);
  add("the polygon's first triangle alone", wrong);
}

/// What becomes of the right vector or matrix in other coordinates, and under other definitions.
void addOtherDefinitions(Quantity quantity, const Configuration& c, const MatrixXd& expected,
                         std::vector<UsualMistake>& mistakes) {
  const Vector3d& n = c.receiver.normal;
  Matrix3d axes;
  axes << tangentFrame<double>(n), n;
  const auto turned = [&](const Matrix3d& turn) -> MatrixXd {
    return expected.cols() == 3 ? MatrixXd(turn * expected * turn.transpose()) : MatrixXd(turn * expected);
  };
  if (expected.rows() == 3) {
    mistakes.push_back(
        {"in the receiver's local frame (t, b, n): not turned back to the world", turned(axes.transpose())});
    addMistake(mistakes, "turned from the receiver's local frame to the world once too often", turned(axes));
  }
  if (quantity == Quantity::kGradient || quantity == Quantity::kHessian) {
    addMistake(mistakes, "the part along the receiver's normal is left out: only the tangent plane is there",
               turned(Matrix3d::Identity() - n * n.transpose()));
  }
  if (quantity == Quantity::kRotationalGradient) {
    const Vector3d g = expected;
    const std::string text =
        "the direction in which the normal should tip, where the axis to turn it about is asked for (n x that)";
    addMistake(mistakes, text, g.cross(n));
    addMistake(mistakes, text + ", of the wrong sign", n.cross(g));
  }
  static const Candidate right = productionCandidate();
  double form_factor = 0.0;
  try {
    form_factor = right.form_factor(c);
  } catch (const std::exception&) {
    return;
  }
  Vector3d area_vector = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < c.polygon.vertices.size(); ++i) {
    area_vector +=
        0.5 * (c.polygon.vertices[i] - c.polygon.vertices[0]).cross(c.polygon.vertices[i + 1] - c.polygon.vertices[0]);
  }
  const double area = area_vector.norm();
  addMistake(mistakes, "multiplied by the polygon's area", expected * area);
  addMistake(mistakes, "divided by the polygon's area", expected / area);
  if (quantity != Quantity::kFormFactor) {
    addMistake(mistakes, "divided by the form factor: the derivative of its logarithm", expected / form_factor);
    addMistake(mistakes, "multiplied by the form factor", expected * form_factor);
  }
}

Eigen::Index rowsOf(Quantity quantity) {
  switch (quantity) {
    case Quantity::kFormFactor:
    case Quantity::kIrradiance:
      return 1;
    case Quantity::kTangentialHessian:
      return 2;
    case Quantity::kGradient:
    case Quantity::kHessian:
    case Quantity::kRotationalGradient:
      break;
  }
  return 3;
}

}  // namespace

std::vector<UsualMistake> usualMistakes(Quantity quantity, const Configuration& configuration,
                                        const MatrixXd& expected) {
  std::vector<UsualMistake> mistakes;
  addMistake(mistakes, signText(quantity), -expected);
  // A check may ask for part of a quantity: a trace, say.
  if (expected.rows() != rowsOf(quantity)) return mistakes;
  addOtherDefinitions(quantity, configuration, expected, mistakes);
  addWrongInputs(quantity, configuration, mistakes);
  addEdgeMistakes(quantity, configuration, expected, mistakes);
  const ClippedPolygon<double> loop = uncut(configuration);
  if (std::ranges::any_of(loop.vertices, [](const auto& vertex) { return vertex.height < 0.0; })) {
    addMistake(mistakes, "the polygon is not cut at the receiver's horizon", uncutSum(quantity, configuration));
  }
  return mistakes;
}

std::string likelyCause(Quantity quantity, const Configuration& configuration, const MatrixXd& expected,
                        const MatrixXd& actual) {
  return diagnose(expected, actual, [&] { return usualMistakes(quantity, configuration, expected); });
}

std::string inWords(const Configuration& configuration) {
  double extent = 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  double lowest = 90.0;
  double highest = -90.0;
  for (const Vector3d& v : configuration.polygon.vertices) {
    const Vector3d r = v - configuration.receiver.position;
    nearest = std::min(nearest, r.norm());
    for (const Vector3d& w : configuration.polygon.vertices) {
      extent = std::max(extent, (v - w).norm());
    }
    const double height =
        std::asin(std::clamp(r.normalized().dot(configuration.receiver.normal), -1.0, 1.0)) * 180.0 / std::numbers::pi;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  std::ostringstream text;
  text.precision(2);
  text << configuration.polygon.vertices.size() << " vertices, " << extent << " across, the nearest " << nearest
       << " away, " << lowest << " to " << highest << " degrees above the horizon";
  return text.str();
}

}  // namespace irradiff
