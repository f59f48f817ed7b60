// What a verdict says to typical mistakes. They are made in formulas of this file, written out from their integrals, so
// that recognising them does not rest on the library's own terms.

#include "derivatives/boundary/irradiance.h"
#include "tests/checks/bad_twins.h"
#include "verification/checks/input_families.h"
#include "verification/checks/oracle_check.h"
#include "verification/checks/suite.h"

#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace irradiff {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint64_t kSeed = 20120806;

template <class Function>
double overEdge(const Function& f) {
  return boost::math::quadrature::gauss<double, 40>::integrate(f, 0.0, 1.0);
}

/// An edge relative to the receiver.
struct Edge {
  Vector3d r, e, n;
  std::size_t index, edges;

  Vector3d at(double t) const { return r + t * e; }
  double s() const {
    return overEdge([&](double t) { return n.dot(at(t)) / std::pow(at(t).norm(), 4); });
  }
  Vector3d q() const {
    Vector3d result;
    for (int k = 0; k < 3; ++k) {
      result(k) = overEdge([&](double t) { return n.dot(at(t)) * at(t)(k) / std::pow(at(t).norm(), 6); });
    }
    return result;
  }
  double i() const {
    return overEdge([&](double t) { return 1.0 / std::pow(at(t).norm(), 4); });
  }
};

std::vector<Edge> edgesOf(const Configuration& c) {
  std::vector<Edge> edges;
  const std::vector<Vector3d>& v = c.polygon.vertices;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vector3d& next = v[(i + 1) % v.size()];
    edges.push_back({v[i] - c.receiver.position, next - v[i], c.receiver.normal, i, v.size()});
  }
  return edges;
}

Candidate gradientOf(const std::function<Vector3d(const Edge&)>& term) {
  Candidate mine{"my gradient"};
  mine.gradient = [term](const Configuration& c) {
    Vector3d sum = Vector3d::Zero();
    for (const Edge& edge : edgesOf(c)) sum += term(edge);
    return Vector3d(sum / std::numbers::pi);
  };
  return mine;
}

Candidate hessianOf(const std::function<Matrix3d(const Edge&)>& term) {
  Candidate mine{"my Hessian"};
  mine.hessian = [term](const Configuration& c) {
    Matrix3d sum = Matrix3d::Zero();
    for (const Edge& edge : edgesOf(c)) sum += term(edge);
    return Matrix3d(sum / std::numbers::pi);
  };
  return mine;
}

Candidate formFactorOf(const std::function<double(const Edge&)>& term) {
  Candidate mine{"my form factor"};
  mine.form_factor = [term](const Configuration& c) {
    double sum = 0.0;
    for (const Edge& edge : edgesOf(c)) sum += term(edge);
    return sum / (2.0 * std::numbers::pi);
  };
  return mine;
}

Matrix3d crossMatrix(const Vector3d& e) {
  Matrix3d m;
  m << 0.0, -e(2), e(1), e(2), 0.0, -e(0), -e(1), e(0), 0.0;
  return m;
}

Vector3d rightGradient(const Edge& edge) { return edge.r.cross(edge.e) * edge.s(); }

Matrix3d rightHessian(const Edge& edge) {
  return edge.s() * crossMatrix(edge.e) + edge.r.cross(edge.e) * (4.0 * edge.q() - edge.i() * edge.n).transpose();
}

double angleOf(const Edge& edge) {
  const Vector3d last = edge.r + edge.e;
  return std::atan2(edge.r.cross(last).norm(), edge.r.dot(last));
}

double rightFormFactor(const Edge& edge) {
  return angleOf(edge) * edge.n.dot(edge.r.cross(edge.e)) / edge.r.cross(edge.e).norm();
}

Verdict judged(const Candidate& candidate, Quantity quantity, double tolerance = 2e-14) {
  for (const Verdict& verdict :
       checkAgainst(multiprecisionOracle(), candidate, drawInputs(inputFamily("well-conditioned"), 20, kSeed),
                    "well-conditioned", Allowance::uniform(tolerance, "the promise"))) {
    if (verdict.quantity == quantity) return verdict;
  }
  throw std::invalid_argument("the candidate does not have the quantity");
}

/// The candidate fails, and the verdict names the cause, of all wrong inputs.
void expectCause(const Candidate& candidate, Quantity quantity, const std::string& cause) {
  const Verdict verdict = judged(candidate, quantity);
  EXPECT_FALSE(verdict.passed);
  EXPECT_EQ(verdict.wrong_inputs, verdict.inputs);
  EXPECT_EQ(verdict.inputs_of_cause, verdict.wrong_inputs);
  EXPECT_THAT(verdict.likely_cause, HasSubstr(cause));
  EXPECT_THAT(describe(verdict), AllOf(HasSubstr("WRONG on 20 of 20 inputs"), HasSubstr("expected"), HasSubstr("got"),
                                       HasSubstr("degrees above the horizon"), HasSubstr("./run evaluate -")));
}

TEST(Diagnosis, TheFormulasOfThisFileAreRight) {
  EXPECT_TRUE(judged(gradientOf(rightGradient), Quantity::kGradient, 1e-12).passed);
  EXPECT_TRUE(judged(hessianOf(rightHessian), Quantity::kHessian, 1e-12).passed);
  EXPECT_TRUE(judged(formFactorOf(rightFormFactor), Quantity::kFormFactor, 1e-12).passed);
}

TEST(Diagnosis, OfAFormFactor) {
  expectCause(formFactorOf([](const Edge& edge) { return std::numbers::pi * rightFormFactor(edge); }),
              Quantity::kFormFactor, "a factor pi too much: irradiance");
  expectCause(formFactorOf([](const Edge& edge) { return edge.n.dot(edge.r.cross(edge.e).normalized()); }),
              Quantity::kFormFactor, "the edge's angle is left out");
  expectCause(formFactorOf([](const Edge& edge) { return edge.n.dot(edge.r.cross(edge.e)) * angleOf(edge); }),
              Quantity::kFormFactor, "not normalised");
  expectCause(formFactorOf([](const Edge& edge) { return rightFormFactor(edge) * 180.0 / std::numbers::pi; }),
              Quantity::kFormFactor, "degrees");
  expectCause(
      formFactorOf([](const Edge& edge) { return std::sin(angleOf(edge)) / angleOf(edge) * rightFormFactor(edge); }),
      Quantity::kFormFactor, "sine of the edge's angle");
  expectCause(formFactorOf([](const Edge& edge) { return edge.index + 1 == edge.edges ? 0.0 : rightFormFactor(edge); }),
              Quantity::kFormFactor, "the last edge, back to the first vertex, is left out");
  expectCause(formFactorOf([](const Edge& edge) { return rightFormFactor(edge) * std::numbers::pi / 3.14159; }),
              Quantity::kFormFactor, "pi is written as 3.14159");
}

TEST(Diagnosis, OfAGradient) {
  expectCause(gradientOf([](const Edge& edge) -> Vector3d { return -rightGradient(edge); }), Quantity::kGradient,
              "the sign is flipped");
  expectCause(gradientOf([](const Edge& edge) -> Vector3d {
                return edge.index == 1 ? -rightGradient(edge) : rightGradient(edge);
              }),
              Quantity::kGradient, "edge 1, from vertex 1 to 2, has the wrong sign");
  expectCause(
      gradientOf([](const Edge& edge) -> Vector3d { return (edge.index == 0 ? 2.0 : 1.0) * rightGradient(edge); }),
      Quantity::kGradient, "edge 0, from vertex 0 to 1, is counted twice");
  expectCause(gradientOf([](const Edge& edge) -> Vector3d { return edge.r.cross(edge.e.normalized()) * edge.s(); }),
              Quantity::kGradient, "the edge vector is normalised");
  expectCause(gradientOf([](const Edge& edge) -> Vector3d { return edge.r.cross(edge.e).normalized() * edge.s(); }),
              Quantity::kGradient, "r x e is normalised");
  expectCause(gradientOf([](const Edge& edge) -> Vector3d {
                return rightGradient(edge) - edge.n * edge.n.dot(rightGradient(edge));
              }),
              Quantity::kGradient, "the part along the receiver's normal is left out");
  expectCause(gradientOf([](const Edge& edge) -> Vector3d {
                const Vector3d g = rightGradient(edge);
                return {g(0), g(2), g(1)};
              }),
              Quantity::kGradient, "come out as (x, z, y)");
  expectCause(gradientOf([](const Edge& edge) -> Vector3d { return rightGradient(edge).cast<float>().cast<double>(); }),
              Quantity::kGradient, "digits are lost");
  expectCause(gradientOf([](const Edge& edge) -> Vector3d {
                Matrix3d frame;
                frame << tangentFrame<double>(edge.n), edge.n;
                return frame.transpose() * rightGradient(edge);
              }),
              Quantity::kGradient, "local frame");
}

TEST(Diagnosis, OfAGradientOfSomethingElse) {
  const Candidate right = gradientOf(rightGradient);
  Candidate mine = right;
  const Candidate form_factor = formFactorOf(rightFormFactor);
  mine.gradient = [right, form_factor](const Configuration& c) -> Vector3d {
    return right.gradient(c) / form_factor.form_factor(c);
  };
  expectCause(mine, Quantity::kGradient, "divided by the form factor");
  mine.gradient = [right](const Configuration& c) -> Vector3d {
    return right.gradient(c).cast<float>().cast<double>();
  };
  expectCause(mine, Quantity::kGradient, "every entry is a float");
  mine.gradient = [form_factor](const Configuration& c) {
    Vector3d g;
    for (int k = 0; k < 3; ++k) {
      Configuration ahead = c;
      ahead.receiver.position(k) += 1e-5;
      g(k) = (form_factor.form_factor(ahead) - form_factor.form_factor(c)) / 1e-5;
    }
    return g;
  };
  expectCause(mine, Quantity::kGradient, "");
}

TEST(Diagnosis, OfVerticesInWrongPlaces) {
  std::vector<Configuration> inputs = drawInputs(inputFamily("well-conditioned"), 20, kSeed);
  // Away from the origin, which a vertex of this family is at.
  for (Configuration& input : inputs) {
    for (Vector3d& v : input.polygon.vertices) v += Vector3d(4.0, 1.0, 2.0);
    input.receiver.position += Vector3d(4.0, 1.0, 2.0);
  }
  const Candidate right = gradientOf(rightGradient);
  for (const auto& [factor, cause] :
       {std::pair{0.0, "the receiver's position is not subtracted"}, std::pair{-1.0, "is added to the vertices"}}) {
    Candidate mine = right;
    mine.gradient = [right, factor = factor](Configuration c) {
      c.receiver.position *= factor;
      return right.gradient(c);
    };
    const Verdict verdict =
        checkAgainst(multiprecisionOracle(), mine, inputs, "moved", Allowance::uniform(1e-12, "the promise")).front();
    EXPECT_EQ(verdict.inputs_of_cause, inputs.size());
    EXPECT_THAT(verdict.likely_cause, HasSubstr(cause));
  }
}

TEST(Diagnosis, OfAHessian) {
  expectCause(hessianOf([](const Edge& edge) -> Matrix3d { return -rightHessian(edge); }), Quantity::kHessian,
              "the sign is flipped");
  expectCause(
      hessianOf([](const Edge& edge) -> Matrix3d { return rightHessian(edge) - edge.s() * crossMatrix(edge.e); }),
      Quantity::kHessian, "the derivative of r x e (product rule)");
  expectCause(
      hessianOf([](const Edge& edge) -> Matrix3d { return rightHessian(edge) - 2.0 * edge.s() * crossMatrix(edge.e); }),
      Quantity::kHessian, "s [e]_x has the wrong sign");
  expectCause(hessianOf([](const Edge& edge) -> Matrix3d {
                return rightHessian(edge) + edge.r.cross(edge.e) * (edge.i() * edge.n).transpose();
              }),
              Quantity::kHessian, "the derivative of n.p");
  expectCause(spoiled(Quantity::kHessian, "off the diagonal doubled",
                      [](const Eigen::MatrixXd& h, const Configuration&) -> Eigen::MatrixXd {
                        return 2.0 * h - Eigen::MatrixXd(h.diagonal().asDiagonal());
                      }),
              Quantity::kHessian, "off the diagonal are doubled");
  expectCause(spoiled(Quantity::kTangentialHessian, "another tangent",
                      [](const Eigen::MatrixXd& h, const Configuration&) -> Eigen::MatrixXd {
                        const Eigen::Rotation2Dd turn(0.3);
                        return turn.toRotationMatrix() * h * turn.toRotationMatrix().transpose();
                      }),
              Quantity::kTangentialHessian, "wrong axes");
}

TEST(Diagnosis, OfARotationalGradient) {
  expectCause(spoiled(Quantity::kRotationalGradient, "tip for axis",
                      [](const Eigen::MatrixXd& g, const Configuration& c) -> Eigen::MatrixXd {
                        return Vector3d(g).cross(c.receiver.normal);
                      }),
              Quantity::kRotationalGradient, "the axis to turn it about");
  expectCause(multiplied(Quantity::kRotationalGradient, std::numbers::pi / 180.0), Quantity::kRotationalGradient,
              "180/pi is missing");
}

TEST(Diagnosis, OfAPolygonNotCutAtTheHorizon) {
  Candidate mine = gradientOf(rightGradient);
  const Verdict verdict = checkAgainst(multiprecisionOracle(), mine, drawInputs(inputFamily("generic"), 20, kSeed),
                                       "horizon", Allowance::uniform(1e-12, "the promise"))
                              .front();
  EXPECT_FALSE(verdict.passed);
  EXPECT_THAT(verdict.likely_cause, HasSubstr("not cut at the receiver's horizon"));
}

/// What is wrong in no known way differs from the right value by another factor each time.
TEST(Diagnosis, MakesNothingOfWhatItDoesNotKnow) {
  const Candidate strange = formFactorOf([](const Edge& edge) { return rightFormFactor(edge) * edge.r.norm(); });
  const Verdict verdict = judged(strange, Quantity::kFormFactor);
  EXPECT_EQ(verdict.likely_cause, "");
  EXPECT_THAT(describe(verdict), HasSubstr("nothing that is usually wrong looks like this"));
}

TEST(Summary, TellsOneMistakeOnce) {
  SuiteOptions options;
  options.inputs = 10;
  options.slow_oracles = false;
  const std::string flipped =
      summarize(checkAll(gradientOf([](const Edge& edge) -> Vector3d { return -rightGradient(edge); }), options));
  EXPECT_THAT(flipped,
              AllOf(HasSubstr("checks failed"), HasSubstr("the sign is flipped"), HasSubstr("passed: scaling")));
  EXPECT_EQ(flipped.find("the sign is flipped"), flipped.rfind("the sign is flipped"));
  EXPECT_LT(std::ranges::count(flipped, '\n'), 20);
  options.tolerance = 1e-12;
  const std::string right = summarize(checkAll(gradientOf(rightGradient), options));
  EXPECT_THAT(right, AllOf(HasSubstr("all "), HasSubstr("checks passed"), Not(HasSubstr("WRONG"))));
  EXPECT_THAT(summarize({}), HasSubstr("nothing"));
}

}  // namespace
}  // namespace irradiff
