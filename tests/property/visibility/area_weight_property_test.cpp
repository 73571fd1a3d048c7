// SPDX-License-Identifier: MIT
// Scores by area do not depend on tessellation; Cauchy's theorem; areas against brute force.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"
#include "vantage/spatial/directions.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/face_visibility.h"

#include "support/random_soup.h"
#include "support/shapes.h"
#include "support/visibility_oracle.h"

namespace vantage {
namespace {

/// A mesh and a field on its vertices.
struct Painted {
  TriMesh mesh{};
  std::vector<double> field{};
};

/// Splits the faces whose centroid has x > 0 into four in their own planes; the new vertices lie on
/// the old edges, so no gap opens. The field is carried over linearly.
Painted split_half(const Painted& shape) {
  Painted result = shape;
  result.mesh.triangles.clear();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of_edge;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, fresh] = middle_of_edge.try_emplace(
        std::minmax(a, b), static_cast<std::uint32_t>(result.mesh.positions.size()));
    if (fresh) {
      result.mesh.positions.emplace_back(0.5 * (shape.mesh.positions[a] + shape.mesh.positions[b]));
      result.field.push_back(0.5 * (shape.field[a] + shape.field[b]));
    }
    return at->second;
  };
  for (const auto& [a, b, c] : shape.mesh.triangles) {
    const Vec3 sum = shape.mesh.positions[a] + shape.mesh.positions[b] + shape.mesh.positions[c];
    if (sum.x() <= 0.0) {
      result.mesh.triangles.push_back({a, b, c});
      continue;
    }
    const std::uint32_t ab = middle(a, b);
    const std::uint32_t bc = middle(b, c);
    const std::uint32_t ca = middle(c, a);
    result.mesh.triangles.insert(result.mesh.triangles.end(),
                                 {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return result;
}

/// A torus with a field that grows towards one place on it, so that its best view is no near-tie.
Painted painted_torus() {
  Painted shape{
      test::moved(test::torus(1.0, 0.4, 60, 30), 1.0, 0.7, Vec3(1.0, 2.0, 3.0), Vec3::Zero()), {}};
  for (const Vec3& p : shape.mesh.positions) {
    shape.field.push_back(std::exp(2.0 * p.x() + p.y() + 0.5 * p.z()));
  }
  return shape;
}

std::vector<double> score_fractions(const Painted& shape, const std::vector<Vec3>& directions) {
  const FaceVisibility faces(shape.mesh, {FaceSides::Front});
  const ViewScorer scorer(faces, shape.field, {.sphere = enclosing_sphere(shape.mesh.positions)});
  std::vector<double> scores = scorer.score_all(directions);
  for (double& score : scores) {
    score /= scorer.total();
  }
  return scores;
}

TEST(SplittingHalfOfAModel, MovesNoScoreByAHundredthAndLeavesTheBestViewWhereItIs) {
  const std::vector<Vec3> directions = direction_set(ViewSphereBase::Icosahedron, 3).directions;
  const Painted coarse = painted_torus();
  const std::vector<double> before = score_fractions(coarse, directions);
  const std::vector<double> after = score_fractions(split_half(split_half(coarse)), directions);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i], before[i], 0.01 * before[i]);
  }
  const auto best = [](const std::vector<double>& scores) {
    return std::max_element(scores.begin(), scores.end()) - scores.begin();
  };
  // The directions are more than 2 degrees apart: within 2 degrees is the same one.
  EXPECT_EQ(best(before), best(after));
}

TEST(MeanShadow, OfConvexBodiesIsAQuarterOfTheirArea) {
  const DirectionSet set = direction_set(ViewSphereBase::Icosahedron, 4);
  const std::vector<double> weights = vertex_areas({set.directions, set.triangles});
  for (const TriMesh& mesh :
       {test::box(1.0, 2.0, 3.0, 1), test::cylinder(1.0, 3.0, 40, 1), test::sphere(2)}) {
    const FaceVisibility visibility(mesh, {FaceSides::Front});
    double shadow = 0.0;
    double sphere = 0.0;
    for (std::size_t i = 0; i < set.directions.size(); ++i) {
      for (const SeenFace& face :
           visibility.seen_faces({Projection::Orthographic, set.directions[i]})) {
        shadow += weights[i] * face.projected_area;
      }
      sphere += weights[i];
    }
    EXPECT_NEAR(shadow / sphere, 0.25 * visibility.total_area(),
                0.001 * 0.25 * visibility.total_area());
  }
}

/// The area of the picture of each face as FaceVisibility says, and as brute force does.
void expect_brute_force_areas(const TriMesh& mesh, FaceSides sides, const Viewpoint& eye) {
  const Sphere sphere = enclosing_sphere(referenced_points(mesh));
  std::vector<double> areas(mesh.triangles.size(), 0.0);
  for (const SeenFace& face : FaceVisibility(mesh, {sides}).seen_faces(eye)) {
    areas[face.face] = face.projected_area;
  }
  const std::vector<double> expected = test::brute_force_areas(mesh, sides, eye, sphere.centre);
  for (std::size_t f = 0; f < areas.size(); ++f) {
    ASSERT_NEAR(areas[f], expected[f], 1e-9 * sphere.diameter * sphere.diameter) << "face " << f;
  }
}

TEST(SeenAreas, ThroughAWindowAreThoseOfBruteForce) {
  const TriMesh wall = test::wall_with_window();
  const TriMesh before = test::together(test::sheet(8.0, 8.0, 1), wall, Vec3(4.0, 4.0, 2.0));
  for (const Vec3& towards : direction_set(ViewSphereBase::Icosahedron, 1).directions) {
    for (const Viewpoint& eye : {Viewpoint{Projection::Orthographic, towards},
                                 Viewpoint{Projection::Perspective, 20.0 * towards}}) {
      expect_brute_force_areas(wall, FaceSides::Front, eye);
      expect_brute_force_areas(before, FaceSides::Both, eye);
    }
  }
}

/// The sheet without the cells in which a place is.
TriMesh without_cells(TriMesh sheet, const std::vector<Vec3>& places) {
  const auto is_left_out = [&](const Triangle& t) {
    const Vec3 middle =
        (sheet.positions[t[0]] + sheet.positions[t[1]] + sheet.positions[t[2]]) / 3.0;
    return std::any_of(places.begin(), places.end(), [&](const Vec3& place) {
      return (middle - place).cwiseAbs().maxCoeff() < 0.5;
    });
  };
  std::erase_if(sheet.triangles, is_left_out);
  return sheet;
}

TEST(SeenAreas, OfLatticesSeenAlongTheirAxesAreThoseOfBruteForce) {
  // Corners of the sheet behind lie exactly behind edges of the other.
  const Viewpoint above{Projection::Orthographic, Vec3(0.0, 0.0, 1.0)};
  std::mt19937 random(3);
  std::uniform_int_distribution<int> cell(0, 4);
  for (int holes = 1; holes < 7; ++holes) {
    std::vector<Vec3> places;
    for (int k = 0; k < holes; ++k) {
      places.emplace_back(cell(random) + 0.5, cell(random) + 0.5, 0.0);
    }
    const TriMesh before = without_cells(test::sheet(5.0, 5.0, 5), places);
    const TriMesh both = test::together(test::sheet(5.0, 5.0, 5), before, Vec3(0.0, 0.0, 1.0));
    expect_brute_force_areas(both, FaceSides::Both, above);
    expect_brute_force_areas(
        test::together(both, without_cells(test::sheet(5.0, 5.0, 5), {places.front()}),
                       Vec3(0.0, 0.0, 2.0)),
        FaceSides::Both, above);
  }
}

TEST(SeenAreas, OfAFaceWhoseCornersOthersTouchAreNothing) {
  // A finer sheet before it is pulled down to the corners of two faces.
  TriMesh before = test::sheet(9.0, 9.0, 36);
  for (Vec3& p : before.positions) {
    p += Vec3(-2.0, -2.0, 1.0);
    for (const Vec3& corner : {Vec3(2, 2, 1), Vec3(3, 2, 1), Vec3(3, 3, 1)}) {
      p.z() = p == corner ? 0.0 : p.z();
    }
  }
  const TriMesh both = test::together(test::sheet(5.0, 5.0, 5), before, Vec3::Zero());
  for (const Vec3& towards : {Vec3(0.0, 0.0, 1.0), Vec3(0.02, 0.013, 1.0)}) {
    const FaceVisibility visibility(both, {FaceSides::Both});
    double behind = 0.0;
    for (const SeenFace& face : visibility.seen_faces({Projection::Orthographic, towards})) {
      behind += face.face < 50 ? face.visible_area : 0.0;  // faces of the sheet
    }
    EXPECT_NEAR(behind, 0.0, 1e-9);
  }
}

TEST(SeenAreas, BehindABandOfLongFacesAreWhatItLeaves) {
  // Faces that are long and aslant make the cells of the picture coarser. The line y = x bounds the band.
  TriMesh band;
  constexpr std::uint32_t kStrips = 30;
  for (std::uint32_t k = 0; k <= kStrips; ++k) {
    const double along = 1.5 * k / kStrips;
    band.positions.emplace_back(along, -along, 1.0);
    band.positions.emplace_back(along + 3.0, 3.0 - along, 1.0);
  }
  for (std::uint32_t k = 0; k < kStrips; ++k) {
    band.triangles.push_back({2 * k, 2 * k + 2, 2 * k + 3});
    band.triangles.push_back({2 * k, 2 * k + 3, 2 * k + 1});
  }
  // Beside it a small plate over a larger one.
  const TriMesh plates =
      test::together(test::sheet(0.4, 0.4, 1), test::sheet(0.2, 0.2, 1), Vec3(0.1, 0.1, 0.5));
  TriMesh all = test::together(band, test::sheet(1.2, 1.2, 1), Vec3(0.9, 1.1, 0.0));
  all = test::together(all, plates, Vec3(4.0, -1.4, 0.0));
  double behind = 0.0;
  double of_plate = 0.0;
  for (const SeenFace& face : FaceVisibility(all, {FaceSides::Both})
                                  .seen_faces({Projection::Orthographic, Vec3(0.0, 0.0, 1.0)})) {
    const std::uint32_t sheet = face.face / 2;  // two faces each, after the band
    behind += sheet == kStrips ? face.visible_area : 0.0;
    of_plate += sheet == kStrips + 1 ? face.visible_area : 0.0;
  }
  EXPECT_NEAR(of_plate, 0.16 - 0.04, 1e-9);
  EXPECT_NEAR(behind, 1.44 - 0.5, 1e-9);
}

TEST(SeenAreas, BehindABarWhoseEndsAreHiddenAreThoseOfBruteForce) {
  // Both ends of the bar's long edges lie behind plates, and what is between them cuts faces of the wall.
  const TriMesh plate = test::sheet(1.5, 2.0, 1);
  TriMesh all =
      test::together(test::sheet(8.0, 8.0, 10), test::sheet(6.0, 0.5, 1), {1.0, 3.9, 1.0});
  all = test::together(all, plate, {0.5, 3.0, 1.5});
  all = test::together(all, plate, {6.0, 3.0, 1.5});
  for (const Vec3& towards : {Vec3(0.0, 0.0, 1.0), Vec3(0.03, -0.05, 1.0).normalized()}) {
    expect_brute_force_areas(all, FaceSides::Both, {Projection::Orthographic, towards});
    expect_brute_force_areas(all, FaceSides::Both, {Projection::Perspective, 40.0 * towards});
  }
}

TEST(SeenAreas, AreThoseOfBruteForce) {
  const TriMesh two_boxes =
      test::together(test::box(1.0, 2.0, 3.0, 1), test::box(1.0, 1.0, 1.0, 1), Vec3(1.5, 0.2, 0.4));
  const TriMesh rings = test::together(test::torus(1.0, 0.4, 16, 8), test::torus(0.8, 0.2, 14, 7),
                                       Vec3(0.3, 0.2, 0.5));  // through each other
  const TriMesh standing =
      test::together(test::sheet(4.0, 4.0, 2), test::box(1.0, 1.0, 1.0, 1), Vec3(1.3, 1.1, 0.0));
  std::mt19937 random(5);
  std::normal_distribution<double> any;
  for (int i = 0; i < 2; ++i) {
    const Vec3 towards = Vec3(any(random), any(random), any(random)).normalized();
    for (const Viewpoint& eye : {Viewpoint{Projection::Orthographic, towards},
                                 Viewpoint{Projection::Perspective, 9.0 * towards}}) {
      expect_brute_force_areas(two_boxes, FaceSides::Front, eye);
      expect_brute_force_areas(rings, FaceSides::Front, eye);
      expect_brute_force_areas(standing, FaceSides::Both, eye);
      expect_brute_force_areas(test::y_of_tubes(0.2, 8), FaceSides::Front, eye);
      expect_brute_force_areas(test::random_soup(40, 3), FaceSides::Both, eye);
    }
  }
}

}  // namespace
}  // namespace vantage
