// SPDX-License-Identifier: MIT
#include "vantage/visibility/face_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/visibility/vertex_visibility.h"

#include "support/many_threads.h"
#include "support/shapes.h"

namespace vantage {
namespace {

const Viewpoint kEyeAbove{Projection::Orthographic, Vec3(0.0, 0.0, 1.0)};

double visible_area(const std::vector<SeenFace>& faces) {
  double sum = 0.0;
  for (const SeenFace& f : faces) {
    sum += f.visible_area;
  }
  return sum;
}

double projected_area(const std::vector<SeenFace>& faces) {
  double sum = 0.0;
  for (const SeenFace& f : faces) {
    sum += f.projected_area;
  }
  return sum;
}

TEST(FaceVisibility, TakesDirectionsOfAnyLength) {
  const FaceVisibility box(test::box(1.0, 2.0, 3.0, 1), {FaceSides::Front});
  const Vec3 direction(1.0, 2.0, 3.0);
  const auto expected = box.seen_faces({Projection::Orthographic, direction});
  for (const double length : {0x1p-1030, 0x1p-600, 0x1p600, 0x1p1020}) {
    const auto faces = box.seen_faces({Projection::Orthographic, Vec3(length * direction)});
    ASSERT_EQ(faces.size(), expected.size()) << length;
    EXPECT_EQ(projected_area(faces), projected_area(expected)) << length;
  }
}

TEST(FaceVisibility, SeesThreeSidesOfABoxOfTwelveTriangles) {
  const FaceVisibility box(test::box(1.0, 2.0, 3.0, 1), {FaceSides::Front});
  const auto faces = box.seen_faces({Projection::Orthographic, Vec3(1.0, 1.0, 1.0)});
  EXPECT_EQ(faces.size(), 6U);
  EXPECT_NEAR(visible_area(faces), 2.0 + 3.0 + 6.0, 1e-12);
  // Each side counts its area times the cosine 1/√3.
  EXPECT_NEAR(projected_area(faces), 11.0 / std::numbers::sqrt3, 1e-12);
}

TEST(FaceVisibility, MeasuresPerspectiveAreasOnThePlaneThroughTheCentre) {
  // Seen from 10 above the centre of a unit cube the top, at distance 9.5, is 10/9.5 times as wide.
  const FaceVisibility cube(test::box(1.0, 1.0, 1.0, 1), {FaceSides::Front});
  const auto faces = cube.seen_faces({Projection::Perspective, Vec3(0.5, 0.5, 10.5)});
  EXPECT_EQ(faces.size(), 2U);
  EXPECT_NEAR(projected_area(faces), std::pow(10.0 / 9.5, 2), 1e-12);
}

TEST(FaceVisibility, ByCornersAFaceCountsWholeIfTwoOfThemAreSeen) {
  // A convex surface is seen face by face, so both ways tell the same.
  const FaceVisibility ball(test::sphere(3), {FaceSides::Front});
  const Viewpoint eye{Projection::Perspective, Vec3(3.0, 1.0, 2.0)};
  const auto exact = ball.seen_surface(eye);
  const auto rough = ball.seen_surface(eye, {}, FaceDetail::ByCorners);
  EXPECT_EQ(rough.vertices, exact.vertices);
  EXPECT_NEAR(projected_area(rough.faces), projected_area(exact.faces), 1e-12);
  // Of two triangles under the edge of a sheet one has two corners in view.
  const FaceVisibility pair(
      test::together(test::sheet(4.0, 4.0, 1), test::sheet(2.0, 6.0, 1), Vec3(0.0, -1.0, 1.0)),
      {FaceSides::Both});
  double under = 0.0;
  for (const SeenFace& face : pair.seen_surface(kEyeAbove, {}, FaceDetail::ByCorners).faces) {
    under += face.face < 2 ? face.visible_area : 0.0;
  }
  EXPECT_NEAR(under, 8.0, 1e-12);
}

/// Another sheet of 4 × 4 over one that begins at x = 0, up to `width`.
TriMesh sheets(double width) {
  return test::together(test::sheet(4.0, 4.0, 1), test::sheet(width, 4.0, 1), Vec3(0.0, 0.0, 1.0));
}

/// Area seen from above of the first two faces.
double seen_of_first(const TriMesh& mesh) {
  double seen = 0.0;
  for (const SeenFace& face : FaceVisibility(mesh, {FaceSides::Both}).seen_faces(kEyeAbove)) {
    seen += face.face < 2 ? face.visible_area : 0.0;
  }
  return seen;
}

TEST(FaceVisibility, SplitsAFaceThatIsPartlyHidden) {
  EXPECT_NEAR(seen_of_first(sheets(2.0)), 8.0, 1e-12);
  EXPECT_NEAR(seen_of_first(sheets(1.37)), 4.0 * (4.0 - 1.37), 1e-12);
  EXPECT_NEAR(seen_of_first(sheets(4.0 - 1e-6)), 4e-6, 1e-12);
}

TEST(FaceVisibility, LooksOnceAtFacesThatStandInOnePlace) {
  // Of nasty models each of hundreds of repeated faces would be held against all others.
  const TriMesh sheet = test::sheet(4.0, 4.0, 1);
  TriMesh repeated = sheet;
  for (int i = 0; i < 9; ++i) {
    repeated = test::together(repeated, sheet, Vec3::Zero());
  }
  const FaceVisibility once(sheet, {FaceSides::Both});
  const FaceVisibility often(repeated, {FaceSides::Both});
  EXPECT_EQ(often.total_area(), once.total_area());
  EXPECT_NEAR(visible_area(often.seen_faces(kEyeAbove)), 16.0, 1e-12);
}

TEST(FaceVisibility, SeesEachOfTwoSheetsBackToBackFromItsSide) {
  const TriMesh sheet = test::sheet(4.0, 4.0, 1);
  TriMesh back = sheet;
  for (Triangle& t : back.triangles) {
    std::swap(t[0], t[1]);
  }
  const FaceVisibility both(test::together(sheet, back, Vec3::Zero()), {FaceSides::Front});
  const auto above = both.seen_faces(kEyeAbove);
  const auto below = both.seen_faces({Projection::Orthographic, Vec3(0.0, 0.0, -1.0)});
  ASSERT_EQ(above.size(), 2U);
  ASSERT_EQ(below.size(), 2U);
  EXPECT_NE(above[0].face / 2, below[0].face / 2);
}

/// A sheet under a frame of eight triangles around a square hole.
TriMesh sheet_under_hole(double size) {
  TriMesh mesh = test::sheet(4.0, 4.0, 1);
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  const std::array<Vec3, 4> corners{Vec3(-0.5, -0.5, 0.0), Vec3(0.5, -0.5, 0.0),
                                    Vec3(0.5, 0.5, 0.0), Vec3(-0.5, 0.5, 0.0)};
  for (const Vec3& corner : corners) {
    mesh.positions.emplace_back(Vec3(2.0, 2.0, 1.0) + 4.0 * corner);
  }
  for (const Vec3& corner : corners) {
    mesh.positions.emplace_back(Vec3(2.611, 1.317, 1.0) + size * corner);
  }
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t next = (k + 1) % 4;
    mesh.triangles.push_back({base + k, base + next, base + 4 + k});
    mesh.triangles.push_back({base + next, base + 4 + next, base + 4 + k});
  }
  return mesh;
}

TEST(FaceVisibility, SeesAFaceThroughAHoleInItsMidst) {
  for (const double size : {0.1, 1e-4}) {
    EXPECT_NEAR(seen_of_first(sheet_under_hole(size)), size * size, 1e-12) << size;
  }
}

TEST(FaceVisibility, SeesWhatATipHidesThatComesThroughAFace) {
  // A pyramid below the sheet whose tip rises above it by a thousandth, amid samples.
  constexpr double kTip = 1e-3;
  TriMesh mesh = test::sheet(4.0, 4.0, 1);
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {Vec3(0.5, 0.5, -1.0), Vec3(-0.5, 0.5, -1.0), Vec3(-0.5, -0.5, -1.0),
                        Vec3(0.5, -0.5, -1.0), Vec3(0.0, 0.0, kTip)}) {
    mesh.positions.emplace_back(p + Vec3(2.611, 1.317, 0.0));
  }
  for (std::uint32_t k = 0; k < 4; ++k) {
    mesh.triangles.push_back({base + k, base + (k + 1) % 4, base + 4});
  }
  const double width = kTip / (1.0 + kTip);
  std::array<double, 2> seen{};
  for (const SeenFace& face : FaceVisibility(mesh, {FaceSides::Both}).seen_faces(kEyeAbove)) {
    seen.at(face.face < 2 ? 0 : 1) += face.projected_area;
  }
  EXPECT_NEAR(seen[0], 16.0 - width * width, 1e-12);
  EXPECT_NEAR(seen[1], width * width, 1e-12);
}

TEST(FaceVisibility, SeesWhatASpikeHidesOverASide) {
  // It comes in over the side x = 0 by a fiftieth, between all samples and far from corners.
  constexpr double kIn = 0.02;
  constexpr double kWidth = 4e-4;
  TriMesh mesh = test::sheet(4.0, 4.0, 1);
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {Vec3(-1.0, 1.3, 1.0), Vec3(kIn, 1.3, 1.0), Vec3(-1.0, 1.3 + kWidth, 1.0)}) {
    mesh.positions.push_back(p);
  }
  mesh.triangles.push_back({base, base + 1, base + 2});
  EXPECT_NEAR(16.0 - seen_of_first(mesh), 0.5 * kIn * kWidth * kIn / (1.0 + kIn), 1e-12);
}

TEST(FaceVisibility, JudgesByPointsWhereThousandsOfFacesLieBeforeOthers) {
  // A staircase of triangles, each a little smaller than the one below.
  TriMesh stairs;
  constexpr std::uint32_t kCount = 8000;
  for (std::uint32_t f = 0; f < kCount; ++f) {
    const double size = f == 0 ? 2.0 : 1.0 - 5e-5 * f;
    const double height = 5e-5 * f;
    for (const Vec3& p :
         {Vec3(0.0, 0.0, height), Vec3(size, 0.0, height), Vec3(0.0, size, height)}) {
      stairs.positions.push_back(p);
    }
    stairs.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  const FaceVisibility visibility(stairs, {FaceSides::Both});
  const std::vector<SeenFace> faces = visibility.seen_faces(kEyeAbove);
  ASSERT_FALSE(faces.empty());
  EXPECT_EQ(faces.front().face, 0U);
  EXPECT_NEAR(faces.front().visible_area, 1.5, 1e-3);  // twelve of sixteen parts
  EXPECT_EQ(faces.back().face, kCount - 1);
  EXPECT_NEAR(faces.back().visible_area, visibility.face_area(kCount - 1), 1e-12);
  EXPECT_LT(faces.size(), kCount);  // no point sees the rims of the rest
}

/// Two boxes that stand side by side, `gap` apart and aside of the middle, before a smaller box
/// that is behind the gap.
TriMesh boxes_with_gap(double gap, int subdivisions) {
  const int n = subdivisions;
  const TriMesh pair = test::together(test::box(1.0, 1.0, 1.0, n), test::box(3.0, 1.0, 1.0, n),
                                      Vec3(1.0 + gap, 0.0, 0.0));
  return test::together(pair, test::box(0.6, 0.4, 0.2, n), Vec3(0.7123, 0.3, -2.0));
}

/// Faces of these seen from the front.
std::vector<SeenFace> faces_seen_through(double gap, const Viewpoint& eye = kEyeAbove) {
  return FaceVisibility(boxes_with_gap(gap, 1), {FaceSides::Front}).seen_faces(eye);
}

TEST(FaceVisibility, SeesFacesThroughANarrowGap) {
  // Two triangles a front.
  constexpr double kGap = 1e-6;
  const std::vector<SeenFace> faces = faces_seen_through(kGap);
  ASSERT_EQ(faces.size(), 6U);
  // It is 0.4 high, and parts of the box's two triangles are seen through it.
  EXPECT_NEAR(faces[4].visible_area + faces[5].visible_area, 0.4 * kGap, 1e-12);
}

TEST(FaceVisibility, SeesFacesThroughAGapInPerspectiveToo) {
  // The eye stands in the plane in the middle of the gap, so that its walls do not hide the box.
  constexpr double kGap = 1e-6;
  const Viewpoint eye{Projection::Perspective, Vec3(1.0 + 0.5 * kGap, 0.45, 6.0)};
  const std::vector<SeenFace> faces = faces_seen_through(kGap, eye);
  constexpr std::uint32_t kFacesOfThePair = 24;
  const auto of_box = std::count_if(faces.begin(), faces.end(), [](const SeenFace& face) {
    return face.face >= kFacesOfThePair;
  });
  EXPECT_EQ(of_box, 2);
}

TEST(FaceVisibility, SeesNothingThroughAGapThatIsClosed) {
  EXPECT_EQ(faces_seen_through(-1e-6).size(), 4U);
}

TEST(FaceVisibility, OfManyFacesSeesTheDeepestThroughAGap) {
  for (const double gap : {1e-6, -1e-6}) {
    const TriMesh mesh = boxes_with_gap(gap, 12);  // 5184 faces
    const Sphere sphere = enclosing_sphere(mesh.positions);
    const double deepest = gap > 0.0 ? -1.8 : 1.0;  // fronts of the small box and of the others
    EXPECT_NEAR(FaceVisibility(mesh, {FaceSides::Front}).seen_surface(kEyeAbove).deepest,
                0.5 - (deepest - sphere.centre.z()) / sphere.diameter, 1e-12)
        << gap;
  }
}

/// A sheet of 4 × 4, of so many squares a side, that falls by `slope` along x.
TriMesh falling_sheet(double slope, int squares) {
  TriMesh sheet = test::sheet(4.0, 4.0, squares);
  for (Vec3& p : sheet.positions) {
    p.z() = -slope * p.x();
  }
  return sheet;
}

TEST(FaceVisibility, GoesAsDeepAsWhatIsSeenOfAFace) {
  // Another sheet hides all that lies beyond x = 1.37, amid the faces.
  for (const int squares : {1, 40}) {
    const TriMesh mesh = test::together(falling_sheet(0.5, squares), test::sheet(2.63, 4.0, 1),
                                        Vec3(1.37, 0.0, 1.0));
    const Sphere sphere = enclosing_sphere(mesh.positions);
    EXPECT_NEAR(FaceVisibility(mesh, {FaceSides::Both}).seen_surface(kEyeAbove).deepest,
                0.5 - (-0.5 * 1.37 - sphere.centre.z()) / sphere.diameter, 1e-12)
        << squares;
  }
}

/// How far the area at a depth is from the mean, over it, at most; of all but the outermost depths.
double unevenness(const SeenSurface& seen) {
  const auto is_empty = [](double area) { return area == 0.0; };
  const auto begin = std::find_if_not(seen.depths.begin(), seen.depths.end(), is_empty);
  const auto end = std::find_if_not(seen.depths.rbegin(), seen.depths.rend(), is_empty).base();
  EXPECT_GT(end - begin, 10);
  EXPECT_NEAR(std::accumulate(begin, end, 0.0), 16.0, 1e-12);
  const double mean =
      std::accumulate(begin + 2, end - 2, 0.0) / static_cast<double>(end - begin - 4);
  const auto [low, high] = std::minmax_element(begin + 2, end - 2);
  return std::max(*high - mean, mean - *low) / mean;
}

TEST(FaceVisibility, SpreadsFacesOverTheDepthsThatTheyReach) {
  for (const double slope : {1.0, 3.0}) {
    const TriMesh sheet = falling_sheet(slope, 7);
    EXPECT_LT(unevenness(FaceVisibility(sheet, {FaceSides::Both}).seen_surface(kEyeAbove)), 1e-12);
  }
}

TEST(FaceVisibility, SeesTheFaceThatAnEdgeIsSeenOfOnlyBetweenWhereItPassesThroughOthers) {
  // A needle lies in a slab but for its back, which comes out along its middle: ends are inside.
  TriMesh slab = test::box(4.0, 1.0, 4.0, 1);
  const std::size_t slab_faces = slab.triangles.size();
  const auto base = static_cast<std::uint32_t>(slab.positions.size());
  // Two roofs, back to back: the ridge rises out of the slab's top at y = 1 between x = 1 and 3 …
  for (const Vec3& p : {Vec3(1.0, 0.9, 2.0), Vec3(2.013, 1.0 + 1e-6, 2.0), Vec3(3.0, 0.9, 2.0),
                        Vec3(2.013, 0.9, 1.9), Vec3(2.013, 0.9, 2.1)}) {
    slab.positions.push_back(p);
  }
  for (const Triangle& t : {Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{0, 4, 1},
                            Triangle{1, 4, 2}, Triangle{0, 3, 4}, Triangle{3, 2, 4}}) {
    slab.triangles.push_back({base + t[0], base + t[1], base + t[2]});
  }
  std::size_t seen = 0;
  for (const SeenFace& face : FaceVisibility(slab, {FaceSides::Both})
                                  .seen_faces({Projection::Orthographic, Vec3::UnitY()})) {
    seen += face.face >= slab_faces ? 1 : 0;
  }
  EXPECT_EQ(seen, 4U);
}

/// Upright sheets side by side across a diagonal of the unit square.
TriMesh grille(std::uint32_t sheets) {
  TriMesh mesh;
  for (std::uint32_t i = 0; i < sheets; ++i) {
    const double x = (i + 0.5) / sheets;
    const std::uint32_t first = 4 * i;
    mesh.positions.insert(mesh.positions.end(), {Vec3(x, 0.0, 0.0), Vec3(x + 1.0, 1.0, 0.0),
                                                 Vec3(x + 1.0, 1.0, 0.1), Vec3(x, 0.0, 0.1)});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

TEST(FaceVisibility, SeesAsMuchOfAGrilleOfThinStripsHoweverManySheetsItHas) {
  const Viewpoint eye{Projection::Orthographic, Vec3(0.1, 0.0, 1.0)};
  const double few = projected_area(FaceVisibility(grille(200), {FaceSides::Both}).seen_faces(eye));
  const double many =
      projected_area(FaceVisibility(grille(2500), {FaceSides::Both}).seen_faces(eye));
  EXPECT_NEAR(many, few, 0.01 * few);
}

TEST(FaceVisibility, ListsSheetsSeenEdgeOnWhereTheyAreAndNowhereElse) {
  // In boxes around them these would be a thousand million places, more than 32 bits count.
  const FaceVisibility sheets(grille(30'000), {FaceSides::Both});
  EXPECT_TRUE(sheets.seen_faces(kEyeAbove).empty());
}

TEST(FaceVisibility, OfAFaceThatTheEyeStandsOnIsNotBlocked) {
  const TriMesh room =
      test::moved(test::box(1.0, 1.0, 1.0, 1), 1.0, 0.7, Vec3(1, 2, 3).normalized(), Vec3::Zero());
  const FaceVisibility walls(room, {FaceSides::Both});
  for (const Triangle& wall : room.triangles) {
    Vec3 eye = Vec3::Zero();
    for (const std::uint32_t v : wall) {
      eye += room.positions[v] / 3.0;
    }
    EXPECT_GE(visible_area(walls.seen_faces({Projection::Perspective, eye})), 5.0 - 1e-9);
  }
}

TEST(FaceVisibility, AnswersForVerticesAsVertexVisibilityDoes) {
  const TriMesh mesh = test::y_of_tubes(0.2, 14);
  const FaceVisibility faces(mesh, {FaceSides::Front});
  const VertexVisibility vertices(mesh, {FaceSides::Front});
  for (const Vec3& eye : {Vec3(5.0, 1.0, 2.0), Vec3(0.1, -4.0, 0.3), Vec3(0.0, 0.0, 0.05)}) {
    const Viewpoint view{Projection::Perspective, eye};
    EXPECT_EQ(faces.seen_surface(view).vertices, vertices.visible_vertices(view));
    EXPECT_EQ(faces.visible_vertices(view), vertices.visible_vertices(view));
  }
}

TEST(FaceVisibility, HidesAFaceBehindOneThatSharesItsCorners) {
  // A flap that is hinged on one side of a face hangs over it: none of the face's corners is
  // hidden, but 0.6 of its area.
  TriMesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1, 0), Vec3(0.5, 0.6, 0.5)};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  const auto faces = FaceVisibility(mesh, {FaceSides::Front}).seen_faces(kEyeAbove);
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_NEAR(faces[0].visible_area, 0.4 * 0.5, 1e-12);
}

TEST(FaceVisibility, IntegratesALinearFieldExactly) {
  // Over the top of the unit cube ∫ (1 + 2x + 3y + 5z) = 1 + 1 + 1.5 + 5.
  const TriMesh cube = test::box(1.0, 1.0, 1.0, 1);
  const FaceVisibility visibility(cube, {FaceSides::Front});
  std::vector<double> field;
  for (const Vec3& p : cube.positions) {
    field.push_back(1.0 + 2.0 * p.x() + 3.0 * p.y() + 5.0 * p.z());
  }
  EXPECT_NEAR(visibility.visible_integral(field, visibility.seen_faces(kEyeAbove)), 8.5, 1e-12);
  double all = 0.0;
  for (const double of_face : visibility.integrals(field)) {
    all += of_face;
  }
  EXPECT_NEAR(all, 6.0 * (1.0 + 1.0 + 1.5 + 2.5), 1e-12);
}

TEST(FaceVisibility, IntegratesALinearFieldOverPartsOfFaces) {
  // Seen are x from 1.37 to 4 of the lower sheet, and all of the upper one.
  const TriMesh mesh = sheets(1.37);
  const FaceVisibility visibility(mesh, {FaceSides::Both});
  std::vector<double> field;
  for (const Vec3& p : mesh.positions) {
    field.push_back(1.0 + 2.0 * p.x() + 3.0 * p.y() + 5.0 * p.z());
  }
  const double lower = 4.0 * (4.0 - 1.37) * (1.0 + (1.37 + 4.0) + 6.0);
  const double upper = 4.0 * 1.37 * (1.0 + 1.37 + 6.0 + 5.0);
  EXPECT_NEAR(visibility.visible_integral(field, visibility.seen_faces(kEyeAbove)), lower + upper,
              1e-10);
}

TEST(FaceVisibility, FromInsideSeesWhatAPlateLeavesOfTheWalls) {
  // A room of 4 × 4 × 4 seen from its middle; a plate half as far as a wall hides a quarter of it.
  TriMesh room = test::box(4.0, 4.0, 4.0, 3);
  for (Vec3& p : room.positions) {
    p -= Vec3(2.0, 2.0, 2.0);
  }
  const std::size_t walls = room.triangles.size();
  const TriMesh mesh = test::together(room, test::sheet(1.0, 1.0, 1), Vec3(-0.5, -0.5, 1.0));
  const FaceVisibility visibility(mesh, {FaceSides::Both});
  std::array<double, 2> seen{};
  for (const SeenFace& face :
       visibility.seen_faces({Projection::Perspective, Vec3(1e-9, 2e-9, -3e-9)})) {
    seen.at(face.face < walls ? 0 : 1) += face.visible_area;
  }
  EXPECT_NEAR(seen[0], 6.0 * 16.0 - 4.0, 1e-6);
  EXPECT_NEAR(seen[1], 1.0, 1e-12);
}

TEST(FaceVisibility, RefusesFacesAndFieldsOfAnotherMesh) {
  const TriMesh ball = test::sphere(1);
  const FaceVisibility faces(ball, {FaceSides::Front});
  EXPECT_THROW((void)faces.face_area(ball.triangles.size()), InvalidInput);
  const std::vector<double> field(ball.positions.size() - 1, 1.0);
  EXPECT_THROW((void)faces.integrals(field), InvalidInput);
  EXPECT_THROW((void)faces.visible_integral(field, {}), InvalidInput);
}

TEST(FaceVisibility, IsTheSameForAnyNumberOfThreads) {
  const FaceVisibility visibility(test::torus(1.0, 0.4, 80, 40), {FaceSides::Front});
  const Viewpoint eye{Projection::Perspective, Vec3(3.0, 1.0, 1.0)};
  const auto one = visibility.seen_faces(eye, {.max_threads = 1});
  const auto three =
      test::with_many_threads([&] { return visibility.seen_faces(eye, {.max_threads = 3}); });
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].face, three[i].face);
    EXPECT_EQ(one[i].projected_area, three[i].projected_area);
  }
}

TEST(VisibleVertices, TurnsAnInsideOutShellBeforeItLooks) {
  const TriMesh torus = test::torus(1.0, 0.4, 24, 12);
  const Vec3 eye(3.0, 1.0, 2.0);
  EXPECT_EQ(visible_vertices(test::inside_out(torus), eye), visible_vertices(torus, eye));
}

TEST(VisibleVertices, SeesTheFarWallFromInsideAnOpenTube) {
  // Both sides of an open surface count: from the axis every vertex is seen.
  const TriMesh tube = test::open_cylinder(1.0, 2.0, 12, 4);
  const auto visible = visible_vertices(tube, Vec3(0.0, 0.0, 1.0));
  EXPECT_EQ(std::count(visible.begin(), visible.end(), 1),
            static_cast<std::ptrdiff_t>(tube.positions.size()));
}

}  // namespace
}  // namespace vantage
