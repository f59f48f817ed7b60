#include "experiments/cache_3d/static_pieces.h"

#include "derivatives/form_factor/polygon_evaluation.h"
#include "derivatives/visibility/scene_evaluation.h"

#include <gtest/gtest.h>

#include <vector>

namespace irradiff {
namespace {

const Receiver kReceiver{{0.1, -0.2, 0.0}, {0.0, 0.0, 1.0}};

Polygon rectangle(double x0, double x1, double y0, double y1, double z, double radiance) {
  return {"rectangle", {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, radiance};
}

Eigen::Matrix2d staticHessian(const std::vector<Polygon>& polygons) {
  const SceneEvaluator evaluator(polygons);
  std::vector<double> radiances;
  for (const Polygon& polygon : polygons) radiances.push_back(polygon.radiance);
  return staticPiecesHessian(evaluator.mesh(), evaluator.view(kReceiver), radiances, kReceiver).value;
}

Eigen::Matrix2d exactHessian(const std::vector<Polygon>& polygons) {
  return SceneEvaluator(polygons).evaluate(kReceiver).derivatives.tangential_hessian.value;
}

/// The largest difference of two matrices over the largest entry of the second.
double difference(const Eigen::Matrix2d& a, const Eigen::Matrix2d& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

// Rounding of projections on planes and of sums of a few terms; 4e-16 to 2e-14 here.
constexpr double kTolerance = 1e-12;

TEST(StaticPieces, HaveTheExactHessianWhereNothingIsHidden) {
  const std::vector<Polygon> scene{rectangle(-1.0, 0.5, -0.7, 0.6, 2.0, 3.0),
                                   rectangle(1.0, 2.0, 0.0, 1.0, 1.0, 0.5),
                                   {"slanted", {{-2.0, 0.0, 0.3}, {-1.0, -1.0, 1.0}, {-2.0, -1.5, 0.7}}, 2.0}};
  // The third is a triangle: any three points are planar.
  EXPECT_LT(difference(staticHessian(scene), exactHessian(scene)), kTolerance);
  std::vector<Polygon> brighter = scene;
  brighter[1].radiance *= 1.01;
  EXPECT_GT(difference(staticHessian(brighter), exactHessian(scene)), kTolerance);
}

TEST(StaticPieces, OfACoveredCornerAreWhatIsLeftCutOutOfIt) {
  // The occluder half way up hides what is beyond x = 0.1 + 2 (0.2 - 0.1) and y = -0.2 + 2 (0.1 + 0.2) of the emitter.
  const std::vector<Polygon> scene{rectangle(-1.0, 1.0, -1.0, 1.0, 2.0, 3.0), rectangle(0.2, 3.0, 0.1, 3.0, 1.0, 0.0)};
  const std::vector<Polygon> pieces{rectangle(-1.0, 0.3, -1.0, 1.0, 2.0, 3.0),
                                    rectangle(0.3, 1.0, -1.0, 0.4, 2.0, 3.0)};
  Eigen::Matrix2d expected = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    expected += 3.0 * evaluatePolygon(pieces[i], i, kReceiver).derivatives.tangential_hessian.value;
  }
  EXPECT_LT(difference(staticHessian(scene), expected), kTolerance);
  // Bad twin: the edges that hide move in the scene itself, which has another Hessian (1.8 times as large).
  EXPECT_GT(difference(exactHessian(scene), expected), 0.1);
}

TEST(StaticPieces, RadiateOnBothSidesOfAnEdge) {
  // A bright occluder before a bright wall: both have pieces along its edges, in planes of their own.
  const std::vector<Polygon> scene{rectangle(-1.0, 1.0, -1.0, 1.0, 2.0, 3.0), rectangle(0.2, 3.0, 0.1, 3.0, 1.0, 0.7)};
  const std::vector<Polygon> black{scene[0], rectangle(0.2, 3.0, 0.1, 3.0, 1.0, 0.0)};
  const std::vector<Polygon> alone{scene[1]};
  EXPECT_LT(difference(staticHessian(scene), staticHessian(black) + exactHessian(alone)), kTolerance);
}

TEST(StaticPieces, EndOnTheHorizon) {
  const std::vector<Polygon> scene{
      {"wall", {{2.0, -1.0, -1.0}, {2.0, 1.0, -1.0}, {2.0, 1.0, 1.5}, {2.0, -1.0, 1.0}}, 2.0},
      rectangle(-1.0, 1.0, -1.0, 1.0, 2.0, 3.0)};
  EXPECT_LT(difference(staticHessian(scene), exactHessian(scene)), kTolerance);
}

}  // namespace
}  // namespace irradiff
