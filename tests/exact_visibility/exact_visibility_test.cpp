#include "verification/exact_visibility/exact_visibility.h"

#include "derivatives/scene/invalid_scene.h"
#include "tests/exact_visibility/visibility_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace irradiff {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::UnorderedElementsAre;

// All scenes here are derived by hand. From the origin, a point (x, y, z) is seen at (x/z, y/z) in the plane z = 1, and
// on the right of a line is what is on the left of its image, drawn with x to the right and y upwards.
const Receiver kUpward{{0, 0, 0}, {0, 0, 1}};

// Its edges 0 to 3 are the lower, the right, the upper and the left one. Everything inside is on their right.
Polygon rectangle(const std::string& name, double radiance, double height, double left, double right, double lower,
                  double upper) {
  return {
      name, {{left, lower, height}, {right, lower, height}, {right, upper, height}, {left, upper, height}}, radiance};
}

// Seen as the square from -1 to 1.
Polygon emitter() { return rectangle("emitter", 1.0, 2, -2, 2, -2, 2); }

std::string errorOf(const std::vector<Polygon>& polygons, const Receiver& receiver = kUpward) {
  try {
    exactVisibility(polygons, receiver);
  } catch (const InvalidScene& error) {
    return error.what();
  }
  return "";
}

TEST(ExactVisibility, NothingIsSeenOfAnEmptySceneNorBelowTheHorizon) {
  for (const auto& scene : {std::vector<Polygon>{}, {rectangle("below", 1.0, -1, -1, 1, -1, 1)}}) {
    const ExactVisibility seen = exactVisibility(scene, kUpward);
    EXPECT_THAT(seen.arcs, IsEmpty());
    EXPECT_THAT(seen.apparent_vertices, IsEmpty());
    EXPECT_THAT(seen.horizon, IsEmpty());
    EXPECT_THAT(seen.edge_on, IsEmpty());
  }
}

TEST(ExactVisibility, OneSquareIsBoundedByItsEdges) {
  const ExactVisibility seen = exactVisibility({emitter()}, kUpward);
  EXPECT_THAT(textsOf(seen.arcs), ElementsAre("0.0 [0, 1] left - right 0", "0.1 [0, 1] left - right 0",
                                              "0.2 [0, 1] left - right 0", "0.3 [0, 1] left - right 0"));
  EXPECT_THAT(seen.apparent_vertices, IsEmpty());
  EXPECT_THAT(seen.horizon, IsEmpty());
  EXPECT_EQ(textOf(seen.arcs[1].begin.point), "(2, -2, 2)");
  EXPECT_EQ(textOf(seen.arcs[1].end.point), "(2, 2, 2)");
}

TEST(ExactVisibility, VertexOrderTurnsTheSides) {
  Polygon turned = emitter();
  std::ranges::reverse(turned.vertices);
  EXPECT_THAT(textsOf(exactVisibility({turned}, kUpward).arcs),
              ElementsAre("0.0 [0, 1] left 0 right -", "0.1 [0, 1] left 0 right -", "0.2 [0, 1] left 0 right -",
                          "0.3 [0, 1] left 0 right -"));
}

TEST(ExactVisibility, ReceiverAndSceneMoveTogether) {
  Polygon moved = emitter();
  for (Eigen::Vector3d& vertex : moved.vertices) vertex += Eigen::Vector3d(0.1, -7, 1000);
  // The vertices are rounded: what the receiver sees is exact for the coordinates given.
  const ExactVisibility seen = exactVisibility({moved}, {{0.1, -7, 1000}, {0, 0, 1}});
  EXPECT_EQ(seen.arcs.size(), 4U);
  EXPECT_EQ(seen.arcs[0].begin.point[2].numerator, "1002");
  EXPECT_EQ(seen.arcs[0].begin.point[0].approximation, -1.9);
}

TEST(ExactVisibility, AnOccluderInsideIsAHole) {
  // Seen as the square from -1/4 to 1/4.
  const ExactVisibility seen =
      exactVisibility({emitter(), rectangle("occluder", 0.0, 1, -0.25, 0.25, -0.25, 0.25)}, kUpward);
  EXPECT_THAT(textsOf(seen.arcs),
              ElementsAre("0.0 [0, 1] left - right 0", "0.1 [0, 1] left - right 0", "0.2 [0, 1] left - right 0",
                          "0.3 [0, 1] left - right 0", "1.0 [0, 1] left 0 right 1", "1.1 [0, 1] left 0 right 1",
                          "1.2 [0, 1] left 0 right 1", "1.3 [0, 1] left 0 right 1"));
  EXPECT_THAT(seen.apparent_vertices, IsEmpty());
}

TEST(ExactVisibility, AnOccluderCutsTheEdgeBehindIt) {
  // Seen from 1/2 to 3/2 by -1/2 to 1/2: the right edge of the emitter, at 1, is hidden for |y/z| < 1/2, |y| < 1.
  const std::vector<Polygon> scene = {emitter(), rectangle("occluder", 0.0, 1, 0.5, 1.5, -0.5, 0.5)};
  const ExactVisibility seen = exactVisibility(scene, kUpward);
  EXPECT_THAT(textsOf(seen.arcs), ElementsAre("0.0 [0, 1] left - right 0", "0.1 [0, 1/4 at 1.0] left - right 0",
                                              "0.1 [3/4 at 1.2, 1] left - right 0", "0.2 [0, 1] left - right 0",
                                              "0.3 [0, 1] left - right 0", "1.0 [0, 1/2 at 0.1] left 0 right 1",
                                              "1.0 [1/2 at 0.1, 1] left - right 1", "1.1 [0, 1] left - right 1",
                                              "1.2 [0, 1/2 at 0.1] left - right 1",
                                              "1.2 [1/2 at 0.1, 1] left 0 right 1", "1.3 [0, 1] left 0 right 1"));
  EXPECT_THAT(textsOf(seen.apparent_vertices), UnorderedElementsAre("(1, -1/2, 1) 1.0 0.1", "(1, 1/2, 1) 1.2 0.1"));
  EXPECT_EQ(textOf(seen.arcs[1].end.point), "(2, -1, 2)");
  EXPECT_EQ(textOf(seen.arcs[5].end.point), "(1, -1/2, 1)");
}

TEST(ExactVisibility, ASlabThroughTheEmitterHasACrease) {
  // The slab stands on the plane x = 1/2, from z = 1 to 4, and meets the emitter at z = 2. In view it runs from x = 1/2
  // (z = 1) over 1/4 (z = 2); beyond, the emitter hides it.
  const Polygon slab{"slab", {{0.5, -0.5, 1}, {0.5, 0.5, 1}, {0.5, 0.5, 4}, {0.5, -0.5, 4}}, 3.0};
  const ExactVisibility seen = exactVisibility({emitter(), slab}, kUpward);
  EXPECT_THAT(
      textsOf(seen.arcs),
      ElementsAre("0.0 [0, 1] left - right 0", "0.1 [0, 1] left - right 0", "0.2 [0, 1] left - right 0",
                  "0.3 [0, 1] left - right 0", "1.0 [0, 1] left 0 right 1", "1.1 [0, 1/3 at 0x1] left 0 right 1",
                  "1.3 [2/3 at 0x1, 1] left 0 right 1", "0x1 [(1/2, -1/2, 2), (1/2, 1/2, 2)] left 1 right 0"));
  EXPECT_THAT(seen.apparent_vertices, IsEmpty());
}

TEST(ExactVisibility, AnEdgeThatRestsOnAPolygonIsNoCrease) {
  // As above, but the slab ends at the emitter.
  const Polygon slab{"slab", {{0.5, -0.5, 1}, {0.5, 0.5, 1}, {0.5, 0.5, 2}, {0.5, -0.5, 2}}, 3.0};
  EXPECT_THAT(textsOf(exactVisibility({emitter(), slab}, kUpward).arcs),
              ElementsAre("0.0 [0, 1] left - right 0", "0.1 [0, 1] left - right 0", "0.2 [0, 1] left - right 0",
                          "0.3 [0, 1] left - right 0", "1.0 [0, 1] left 0 right 1", "1.1 [0, 1] left 0 right 1",
                          "1.2 [0, 1] left 0 right 1", "1.3 [0, 1] left 0 right 1"));
}

TEST(ExactVisibility, TheHorizonCutsEdges) {
  // Of the emitter the half x > 0 is above the horizon. About n = (1, 0, 0) it is seen from (0, 1, 1) to (0, -1, 1).
  const ExactVisibility seen = exactVisibility({emitter()}, {{0, 0, 0}, {1, 0, 0}});
  EXPECT_THAT(textsOf(seen.arcs), ElementsAre("0.0 [1/2 horizon, 1] left - right 0", "0.1 [0, 1] left - right 0",
                                              "0.2 [0, 1/2 horizon] left - right 0"));
  EXPECT_THAT(textsOf(seen.horizon), ElementsAre("(0, 2, 2) to (0, -2, 2) polygon 0"));
  EXPECT_EQ(textOf(seen.arcs[0].begin.point), "(0, -2, 2)");
}

TEST(ExactVisibility, AWallIsCutByTheHorizonOfATiltedReceiver) {
  // Heights 2x + z over the horizon, times 1/sqrt(5), which is no double: n is (2, 0, 1) times the double next to it.
  // (-1, y, 1) is at height -1, (-1, y, 4) at 2: the upright edges are cut at a third of their length.
  const Receiver tilted{{0, 0, 0}, {2.0 * 0.4472135954999579, 0, 0.4472135954999579}};
  const Polygon wall{"wall", {{-1, -1, 1}, {-1, 1, 1}, {-1, 1, 4}, {-1, -1, 4}}, 1.0};
  const ExactVisibility seen = exactVisibility({wall}, tilted);
  // (-1, 1, 1) x (0, 0, 3) = (3, 3, 0) points away from the wall: it is on the left.
  EXPECT_THAT(textsOf(seen.arcs), ElementsAre("0.1 [1/3 horizon, 1] left 0 right -", "0.2 [0, 1] left 0 right -",
                                              "0.3 [0, 2/3 horizon] left 0 right -"));
  EXPECT_THAT(textsOf(seen.horizon), ElementsAre("(-1, 1, 2) to (-1, -1, 2) polygon 0"));
}

TEST(ExactVisibility, AWallOnTheHorizonIsBoundedByItFromBelow) {
  // Its lower edge lies on the horizon and is no arc; the horizon's own arc is there.
  const Polygon wall{"wall", {{1, -1, 0}, {1, 1, 0}, {1, 1, 1}, {1, -1, 1}}, 1.0};
  const ExactVisibility seen = exactVisibility({wall}, kUpward);
  // (1, 1, 0) x (0, 0, 1) = (1, -1, 0) points into the wall.
  EXPECT_THAT(textsOf(seen.arcs), ElementsAre("0.1 [0 horizon, 1] left - right 0", "0.2 [0, 1] left - right 0",
                                              "0.3 [0, 1 horizon] left - right 0"));
  EXPECT_THAT(textsOf(seen.horizon), ElementsAre("(1, -1, 0) to (1, 1, 0) polygon 0"));
}

TEST(ExactVisibility, TheNearestPolygonIsOnTheHorizon) {
  // Three walls one behind the other, seen on the horizon at y/x from -1 to 1, -1/2 to 1/2, and 0 to 2.
  const auto wall = [](double x, double from, double to) {
    return Polygon{"wall", {{x, from, -1}, {x, to, -1}, {x, to, 1}, {x, from, 1}}, 1.0};
  };
  const ExactVisibility seen = exactVisibility({wall(2, -2, 2), wall(1, -0.5, 0.5), wall(4, 0, 8)}, kUpward);
  EXPECT_THAT(textsOf(seen.horizon),
              UnorderedElementsAre("(2, -2, 0) to (1, -1/2, 0) polygon 0", "(1, -1/2, 0) to (1, 1/2, 0) polygon 1",
                                   "(1, 1/2, 0) to (2, 2, 0) polygon 0", "(2, 2, 0) to (4, 8, 0) polygon 2"));
}

TEST(ExactVisibility, OccludersThatOverlap) {
  // Seen: emitter -1 to 1; a from -1/2 to 1/4 by -1/4 to 1/4; b in front of it, from 0 to 1/2 by 0 to 1/2.
  const ExactVisibility seen = exactVisibility(
      {emitter(), rectangle("a", 0.0, 1.5, -0.75, 0.375, -0.375, 0.375), rectangle("b", 0.0, 1, 0, 0.5, 0, 0.5)},
      kUpward);
  EXPECT_THAT(textsOf(seen.arcs), ElementsAre("0.0 [0, 1] left - right 0", "0.1 [0, 1] left - right 0",
                                              "0.2 [0, 1] left - right 0", "0.3 [0, 1] left - right 0",
                                              "1.0 [0, 1] left 0 right 1",           //
                                              "1.1 [0, 1/2 at 2.0] left 0 right 1",  // from -1/4 to 0
                                              "1.2 [1/3 at 2.3, 1] left 0 right 1",  // from 0 to -1/2
                                              "1.3 [0, 1] left 0 right 1",           //
                                              "2.0 [0, 1/2 at 1.1] left 1 right 2",  // in front of a up to 1/4
                                              "2.0 [1/2 at 1.1, 1] left 0 right 2",  //
                                              "2.1 [0, 1] left 0 right 2",           //
                                              "2.2 [0, 1] left 0 right 2",           //
                                              "2.3 [0, 1/2 at 1.2] left 0 right 2",  // from 1/2 to 1/4
                                              "2.3 [1/2 at 1.2, 1] left 1 right 2"));
  EXPECT_THAT(textsOf(seen.apparent_vertices), UnorderedElementsAre("(1/4, 0, 1) 2.0 1.1", "(0, 1/4, 1) 2.3 1.2"));
}

TEST(ExactVisibility, AHiddenCrossingIsNoApparentVertex) {
  // What crosses behind the screen does not count; the screen's own edges see the emitter alone.
  const std::vector<Polygon> scene = {emitter(), rectangle("a", 0.0, 1.5, -0.75, 0.375, -0.375, 0.375),
                                      rectangle("b", 0.0, 1, 0, 0.5, 0, 0.5),
                                      rectangle("screen", 0.0, 0.5, -0.4, 0.4, -0.4, 0.4)};
  const ExactVisibility seen = exactVisibility(scene, kUpward);
  EXPECT_EQ(seen.arcs.size(), 8U);
  EXPECT_THAT(seen.apparent_vertices, IsEmpty());
}

TEST(ExactVisibility, ThreeEdgesThroughOneDirectionAreDegenerate) {
  // In view: the far edge is x = 0, the middle one the diagonal, the near one y = 0; all pass through the normal.
  const std::vector<Polygon> scene = {rectangle("far", 1.0, 4, -4, 0, -4, 4),
                                      {"middle", {{-0.5, -0.5, 2}, {0.5, 0.5, 2}, {0.5, -0.5, 2}}, 2.0},
                                      rectangle("near", 3.0, 1, -0.5, 0.5, 0, 0.5)};
  const ExactVisibility seen = exactVisibility(scene, kUpward);
  EXPECT_THAT(textsOf(seen.apparent_vertices),
              UnorderedElementsAre("(0, 0, 1) 2.0 1.0 0.1 degenerate", "(0, -1/4, 1) 1.2 0.1", "(1/4, 0, 1) 2.0 1.1",
                                   "(0, 1/2, 1) 2.2 0.1"));
  // The far edge, from -1 to 1, is hidden by the triangle from -1/4 to 0 and by the near square from there to 1/2.
  EXPECT_THAT(textsOf(seen.arcs),
              IsSupersetOf({"0.1 [0, 3/8 at 1.2] left - right 0", "0.1 [3/4 at 2.2, 1] left - right 0",
                            "1.0 [0, 1/2 at 2.0 0.1] left 1 right 0", "2.0 [0, 1/2 at 1.0 0.1] left 0 right 2",
                            "2.0 [1/2 at 1.0 0.1, 3/4 at 1.1] left 1 right 2"}));
}

TEST(ExactVisibility, AVertexOnAForeignEdgeIsDegenerate) {
  // In view the near square's corner (1/2, 1/2) lies on the far triangle's edge x + y = 1, from either side of it.
  const Polygon far{"far", {{4, 0, 4}, {0, 4, 4}, {0, 0, 4}}, 1.0};
  const Polygon near_inside = rectangle("near", 0.0, 1, 0.25, 0.5, 0.25, 0.5);
  const Polygon near_outside = rectangle("near", 0.0, 1, 0.5, 1, 0.5, 1);
  EXPECT_THAT(textsOf(exactVisibility({far, near_inside}, kUpward).apparent_vertices),
              ElementsAre("(1/2, 1/2, 1) 1.1 1.2 0.0 degenerate"));
  EXPECT_THAT(textsOf(exactVisibility({far, near_outside}, kUpward).apparent_vertices),
              ElementsAre("(1/2, 1/2, 1) 1.0 1.3 0.0 degenerate"));
  // A far corner that touches a near edge from behind is seen nowhere, yet the slightest motion may bring it out.
  const Polygon hidden{"hidden", {{0, 0, 2}, {-1, 0.25, 2}, {-1, -0.25, 2}}, 1.0};
  const Polygon cover = rectangle("cover", 0.0, 1, -1, 0, -1, 1);
  EXPECT_THAT(textsOf(exactVisibility({hidden, cover}, kUpward).apparent_vertices),
              ElementsAre("(0, 0, 1) 1.1 0.0 0.2 degenerate"));
}

TEST(ExactVisibility, EdgesThatCoincideInViewAreAligned) {
  // The near square's right edge and the far one's left edge, which runs downwards, are both seen at x = 0 for |y| <=
  // 1/2.
  const ExactVisibility seen =
      exactVisibility({rectangle("far", 1.0, 2, 0, 2, -2, 2), rectangle("near", 2.0, 1, -1, 0, -0.5, 0.5)}, kUpward);
  EXPECT_THAT(textsOf(seen.arcs),
              IsSupersetOf({"1.1 [0 on 0.3, 1 on 0.3] left 0 right 1 aligned 0.3",
                            "0.3 [0, 1/4 at 1.1 1.2] left - right 0", "0.3 [3/4 at 1.0 1.1, 1] left - right 0"}));
}

TEST(ExactVisibility, AnEdgeOfTwoPolygonsIsNamedOnce) {
  // A square of two triangles; the diagonal is edge 2 of the one, edge 0 of the other.
  const Polygon lower{"lower", {{-2, -2, 2}, {2, -2, 2}, {2, 2, 2}}, 1.0};
  const Polygon upper{"upper", {{-2, -2, 2}, {2, 2, 2}, {-2, 2, 2}}, 2.0};
  EXPECT_THAT(textsOf(exactVisibility({lower, upper}, kUpward).arcs),
              ElementsAre("0.0 [0, 1] left - right 0", "0.1 [0, 1] left - right 0", "0.2 [0, 1] left 1 right 0",
                          "1.1 [0, 1] left - right 1", "1.2 [0, 1] left - right 1"));
  // As a screen they hide what crosses behind their common edge.
  const std::vector<Polygon> screened = {lower, upper, rectangle("far", 1.0, 3, -1, 1, -1, 0.5)};
  EXPECT_EQ(exactVisibility(screened, kUpward).arcs.size(), 5U);
  EXPECT_THAT(exactVisibility(screened, kUpward).apparent_vertices, IsEmpty());
}

TEST(ExactVisibility, APolygonInAPlaneWithTheReceiverHasNoImage) {
  const Polygon edge_on{"edge on", {{0, -1, 1}, {0, 1, 1}, {0, 0, 2}}, 1.0};
  const Polygon own_surface = rectangle("own surface", 1.0, 0, -1, 1, -1, 1);
  const ExactVisibility seen = exactVisibility({edge_on, emitter(), own_surface}, kUpward);
  EXPECT_THAT(seen.edge_on, ElementsAre(0, 2));
  EXPECT_EQ(seen.arcs.size(), 4U);
  EXPECT_THAT(seen.horizon, IsEmpty());
  // A double's last place away it has one.
  Polygon nearly = edge_on;
  nearly.vertices[2].x() = 0x1p-1074;
  EXPECT_EQ(exactVisibility({nearly, emitter()}, kUpward).arcs.size(), 7U);
}

TEST(ExactVisibility, ANonConvexPolygonShowsWhatIsBehindItsNotch) {
  // The notch reaches from the upper edge down to (0, 0); through it and beside it the emitter is seen.
  const Polygon notched{"notched", {{-0.5, -0.5, 1}, {0.5, -0.5, 1}, {0.5, 0.5, 1}, {0, 0, 1}, {-0.5, 0.5, 1}}, 0.0};
  const ExactVisibility seen = exactVisibility({emitter(), notched}, kUpward);
  EXPECT_EQ(seen.arcs.size(), 9U);
  EXPECT_THAT(textsOf(seen.arcs), Contains("1.2 [0, 1] left 0 right 1"));
  EXPECT_THAT(textsOf(seen.arcs), Contains("1.3 [0, 1] left 0 right 1"));
}

TEST(ExactVisibility, RefusesWhatIsNotExactlyPlanar) {
  Polygon bent = emitter();
  bent.vertices[3].z() += 0x1p-51;
  EXPECT_THAT(errorOf({emitter(), bent}),
              AllOf(HasSubstr("polygons[1] \"emitter\""), HasSubstr("vertex 3 (-2, 2, 2.0000000000000004)"),
                    HasSubstr("must be exactly in it")));
  EXPECT_THAT(errorOf({{"line", {{0, 0, 1}, {1, 0, 1}, {2, 0, 1}}, 1.0}}), HasSubstr("polygons[0] \"line\""));
  EXPECT_THAT(errorOf({emitter()}, {{0, 0, 0}, {0, 0, 2}}), HasSubstr("receiver 0: normal"));
}

TEST(ExactVisibility, RefusesCoplanarOverlapOfDifferentRadianceWhereItIsSeen) {
  const Polygon first = rectangle("first", 1.0, 2, -2, 0, -1, 1);
  const Polygon second = rectangle("second", 2.0, 2, -1, 1, -1, 1);
  const auto names_both = AllOf(HasSubstr("polygons[0] \"first\""), HasSubstr("polygons[1] \"second\""));
  EXPECT_THAT(errorOf({first, second}), names_both);
  // Hidden behind a screen, below the horizon, or of equal radiance they may; where they only touch, too.
  EXPECT_EQ(errorOf({first, second, rectangle("screen", 0.0, 1, -2, 2, -2, 2)}), "");
  EXPECT_EQ(errorOf({first, second}, {{0, 0, 0}, {0, 0, -1}}), "");
  EXPECT_EQ(errorOf({first, rectangle("touching", 2.0, 2, 0, 1, -1, 1)}), "");
  const Polygon equal = rectangle("equal", 1.0, 2, -1, 1, -1, 1);
  EXPECT_THAT(textsOf(exactVisibility({first, equal}, kUpward).arcs),
              ElementsAre("0.0 [0, 1] left - right 0", "0.1 [0, 1] left 1 right 0", "0.2 [0, 1] left - right 0",
                          "0.3 [0, 1] left - right 0", "1.0 [1/2 at 0.1, 1] left - right 1",
                          "1.1 [0, 1] left - right 1", "1.2 [0, 1/2 at 0.1] left - right 1"));
}

}  // namespace
}  // namespace irradiff
