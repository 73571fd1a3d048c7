// SPDX-License-Identifier: MIT
#include "spatial/shell.h"

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "vantage/mesh/measures.h"

#include "core/random.h"
#include "support/dense_oracles.h"
#include "support/shapes.h"
#include "support/skeletons.h"
#include "support/voxel_surface.h"

namespace vantage {
namespace {

using test::one_component;

/// A sphere whose vertices stand at random radii: long faces askew, of which many lie over one another.
TriMesh spiky_sphere() {
  Pcg32 random(7);
  TriMesh mesh = test::sphere(3);
  for (Vec3& p : mesh.positions) {
    p *= 0.1 + 0.9 * random.uniform();
  }
  return mesh;
}

TEST(ShellInside, AgreesWithSolidAnglesAtRandomPoints) {
  Pcg32 random(3);
  for (const TriMesh& mesh : {test::torus(1.0, 0.3, 20, 10), test::cube_frame(), spiky_sphere(),
                              test::inside_out(test::y_of_tubes(0.3, 12))}) {
    const auto components = one_component(mesh);
    const Shell shell(mesh, components);
    const Box box = bounding_box(mesh.positions);
    for (int i = 0; i < 500; ++i) {
      const Vec3 share(random.uniform(), random.uniform(), random.uniform());
      const Vec3 p = box.low + share.cwiseProduct(box.size());
      EXPECT_EQ(shell.inside(0, p), std::abs(test::winding_number(mesh, p)) > 0.5);
    }
  }
}

TEST(ShellInside, DoesNotHangOnWhereALoneVertexIs) {
  const TriMesh ball = test::sphere(3);
  TriMesh with_stray = ball;
  with_stray.positions.emplace_back(1e9, 0.0, 0.0);
  const auto components = one_component(ball);
  const auto with_stray_components = one_component(with_stray);
  const Shell shell(ball, components);
  const Shell other(with_stray, with_stray_components);
  Pcg32 random(5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p =
        2.4 * Vec3(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
    EXPECT_EQ(other.inside(0, p), shell.inside(0, p)) << p.transpose();
  }
}

TEST(ShellInside, TakesLittleMemoryWhereThousandsOfFacesLieOverOneAnother) {
  // 20 000 tetrahedra in one place: each face reaches over half the grid, 1.6e9 entries of cells.
  TriMesh mesh;
  for (std::uint32_t copy = 0; copy < 20'000; ++copy) {
    const double lift = 1e-6 * copy;
    for (const Vec3& p :
         {Vec3(0, 0, lift), Vec3(1, 0, lift), Vec3(0, 1, lift), Vec3(0, 0, 1 + lift)}) {
      mesh.positions.push_back(p);
    }
    const std::uint32_t a = 4 * copy;
    for (const Triangle& t : {Triangle{a, a + 2, a + 1}, Triangle{a, a + 1, a + 3},
                              Triangle{a, a + 3, a + 2}, Triangle{a + 1, a + 2, a + 3}}) {
      mesh.triangles.push_back(t);
    }
  }
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  EXPECT_LE(shell.grid_entries(), 64 * mesh.triangles.size());
  EXPECT_TRUE(shell.inside(0, Vec3(0.2, 0.2, 0.3)));
  EXPECT_FALSE(shell.inside(0, Vec3(0.9, 0.9, 0.3)));
}

TEST(ShellInside, HasNoGapsAboveEdgesAndCorners) {
  // Straight below and above the grid lines of the box's lids and its corners.
  const TriMesh mesh = test::box(4, 4, 1, 4);
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  for (const double z : {-0.5, 0.5, 1.5}) {
    for (int cell = 0; cell < 9; ++cell) {
      const int row = 1 + cell / 3;
      EXPECT_EQ(shell.inside(0, Vec3(row, 1 + cell % 3, z)), z == 0.5);
    }
  }
}

TEST(ShellInside, WhatIsOnTheSurfaceIsNotWellInside) {
  const TriMesh mesh = test::box(4, 4, 1, 4);
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  for (const double z : {0.0, 1.0}) {
    EXPECT_FALSE(shell.well_inside(0, Vec3(1.3, 2.6, z)));
  }
  EXPECT_TRUE(shell.well_inside(0, Vec3(1.3, 2.6, 0.001)));
  EXPECT_FALSE(shell.well_inside(0, Vec3(1.3, 2.6, -0.001)));
}

TEST(ShellInside, LooksAtOneComponentOnly) {
  const TriMesh mesh = test::together(test::sphere(2), test::sphere(2), Vec3(5, 0, 0));
  std::vector<std::uint32_t> components(mesh.positions.size(), 0);
  std::fill(components.begin() + static_cast<std::ptrdiff_t>(components.size() / 2),
            components.end(), 1);
  const Shell shell(mesh, components);
  EXPECT_TRUE(shell.inside(0, Vec3(0, 0, 0)));
  EXPECT_FALSE(shell.inside(1, Vec3(0, 0, 0)));
  EXPECT_TRUE(shell.inside(1, Vec3(5, 0, 0)));
}

TEST(ShellInside, AGridOfEachComponentHasAboutTwoFacesACellHoweverFarApartTheyAre) {
  // A grid over both has each of them in one cell, where every look meets all of its faces.
  const TriMesh mesh = test::together(test::sphere(4), test::sphere(1), Vec3(1e4, 0, 3e3));
  std::vector<std::uint32_t> components(mesh.positions.size(), 1);
  std::fill(components.begin(),
            components.begin() + static_cast<std::ptrdiff_t>(test::sphere(4).positions.size()), 0);
  const Shell shell(mesh, components);
  EXPECT_LE(shell.faces_met(0), 20.0);
  EXPECT_TRUE(shell.inside(0, Vec3(0.1, 0.2, 0.3)));
  EXPECT_TRUE(shell.inside(0, Vec3(0.9, 0, 0), Vec3(-0.9, 0, 0)));
  EXPECT_FALSE(shell.inside(0, Vec3(0, 0, 0), Vec3(1e4, 0, 3e3)));
  EXPECT_TRUE(shell.inside(1, Vec3(1e4, 0.1, 3e3)));
}

TEST(ShellInside, AnOpenSurfaceHasNoOutside) {
  const TriMesh mesh = test::open_cylinder(0.3, 1.0, 8, 4);
  const auto components = one_component(mesh);
  EXPECT_TRUE(Shell(mesh, components).inside(0, Vec3(9, 9, 9)));
}

TEST(ShellInside, ASegmentThroughAHoleIsNotInside) {
  const TriMesh mesh = test::torus(1.0, 0.3, 20, 10);
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  EXPECT_FALSE(shell.inside(0, Vec3(1, 0, 0), Vec3(-1, 0, 0)));
  EXPECT_TRUE(shell.inside(0, Vec3(1, 0, 0), Vec3(1, 0.1, 0)));
}

TEST(ShellMiddle, OfASphereIsItsCentre) {
  const TriMesh mesh = test::sphere(3);
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  for (std::uint32_t v = 0; v < 20; ++v) {
    const std::optional<Vec3> middle = shell.middle_at(v);
    ASSERT_TRUE(middle);
    EXPECT_LE(middle->norm(), 0.02);  // the wall across is a chord of edges 0.14 long
  }
}

TEST(ShellMiddle, IsFoundInAShellTurnedInsideOut) {
  const TriMesh mesh = test::inside_out(test::sphere(3));
  const auto components = one_component(mesh);
  const std::optional<Vec3> middle = Shell(mesh, components).middle_at(0);
  ASSERT_TRUE(middle);
  EXPECT_LE(middle->norm(), 0.02);
}

TEST(ShellWall, GoesStraightThroughABoxAlongItsGrid) {
  // From corners of cells to corners of cells: every ray runs along edges of the grid.
  const TriMesh mesh = test::box(4, 4, 1, 4);
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  int walls = 0;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    if (p.x() > 0.5 && p.x() < 3.5 && p.y() > 0.5 && p.y() < 3.5) {
      const auto wall = shell.wall_at(v);
      ASSERT_TRUE(wall.has_value());
      EXPECT_LE((*wall - Vec3(0, 0, p.z() > 0.5 ? -1 : 1)).norm(), 1e-12);
      ++walls;
    }
  }
  EXPECT_EQ(walls, 18);
}

/// Length along a unit direction to the nearest face, of all faces; infinite if none is met.
double nearest_face(const TriMesh& mesh, const Vec3& from, const Vec3& direction, double skip) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles) {
    Eigen::Matrix3d sides;
    sides << mesh.positions[t[1]] - mesh.positions[t[0]],
        mesh.positions[t[2]] - mesh.positions[t[0]], -direction;
    const Vec3 at = sides.inverse() * (from - mesh.positions[t[0]]);
    if (at[0] >= 0.0 && at[1] >= 0.0 && at[0] + at[1] <= 1.0 && at[2] > skip) {
      nearest = std::min(nearest, at[2]);
    }
  }
  return nearest;
}

TEST(ShellWall, IsTheNearestOfAllFacesAcrossTheInside) {
  const TriMesh mesh = spiky_sphere();
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  const double size = bounding_box(mesh.positions).longest_side();
  std::vector<Vec3> normals(mesh.positions.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      normals[v] += area_vector(mesh, t);
    }
  }
  for (std::uint32_t v = 0; v < mesh.positions.size(); v += 3) {
    double expected = 0.0;  // none
    for (const double sense : {-1.0, 1.0}) {
      const Vec3 direction = sense * normals[v].normalized();
      const double length = nearest_face(mesh, mesh.positions[v], direction, 1e-4 * size);
      if (std::isfinite(length) && std::abs(test::winding_number(
                                       mesh, mesh.positions[v] + 0.5 * length * direction)) > 0.5) {
        expected = length;
        break;
      }
    }
    const auto wall = shell.wall_at(v);
    EXPECT_NEAR(wall.value_or(Vec3::Zero()).norm(), expected, 1e-9) << v;
  }
}

TEST(ShellWall, IsTheSameByRaysAsByTheGrid) {
  const TriMesh mesh = spiky_sphere();
  const auto components = one_component(mesh);
  const Shell by_grid(mesh, components);
  const Shell by_rays(mesh, components, 0);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 grid = by_grid.wall_at(v).value_or(Vec3::Zero());
    const Vec3 rays = by_rays.wall_at(v).value_or(Vec3::Zero());
    EXPECT_LE((grid - rays).norm(), 1e-5) << v;  // rays are in single precision
  }
}

TEST(ShellWall, IsFoundWhereLongFacesCrowdTheGrid) {
  constexpr double kRadius = 1e-3;
  const TriMesh mesh = test::cylinder(kRadius, 1.0, 1000, 3);  // each cell has a third of all faces
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  int walls = 0;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const auto wall = shell.wall_at(v);
    const double share = std::abs(mesh.positions[v].z() / 1.0);
    if (share > 0.1 && share < 0.4) {  // no rim, wherever the middle of the height is
      ASSERT_TRUE(wall.has_value());
      EXPECT_NEAR(wall->norm(), 2.0 * kRadius, 1e-2 * kRadius);
      ++walls;
    }
  }
  EXPECT_GE(walls, 1000);
}

TEST(ShellOutsideLength, OfAChordIsWhatLiesInTheHole) {
  // A ring of 40 × 12: vertices at the x axis have the exact radii 0.75 and 1.25.
  const TriMesh mesh = test::torus(1.0, 0.25, 40, 12);
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  EXPECT_NEAR(shell.outside_length(0, Vec3(1, 0, 0), Vec3(-1, 0, 0)), 1.5, 1e-9);
  EXPECT_EQ(shell.outside_length(0, Vec3(1, 0, 0), Vec3(1, 0.1, 0)), 0.0);
}

TEST(ShellOutsideLength, AgreesWithSolidAnglesAlongRandomSegments) {
  constexpr int kSamples = 400;
  Pcg32 random(11);
  for (const TriMesh& mesh : {test::torus(1.0, 0.3, 20, 10), test::cube_frame()}) {
    const auto components = one_component(mesh);
    const Shell shell(mesh, components);
    const Box box = bounding_box(mesh.positions);
    const auto anywhere = [&] {
      const Vec3 share(random.uniform(), random.uniform(), random.uniform());
      return Vec3(box.low + share.cwiseProduct(box.size()));
    };
    for (int i = 0; i < 30; ++i) {
      const Vec3 a = anywhere();
      const Vec3 b = anywhere();
      int outside = 0;
      for (int s = 0; s < kSamples; ++s) {
        const double t = (s + 0.5) / kSamples;
        outside += std::abs(test::winding_number(mesh, (1.0 - t) * a + t * b)) < 0.5 ? 1 : 0;
      }
      // Each of at most eight crossings is found up to one sample.
      EXPECT_NEAR(shell.outside_length(0, a, b) / (b - a).norm(),
                  static_cast<double>(outside) / kSamples, 8.0 / kSamples);
    }
  }
}

TEST(ShellOutsideLength, AgreesWithSolidAnglesAmongSpikes) {
  constexpr int kSamples = 200;
  Pcg32 random(5);
  const TriMesh mesh = spiky_sphere();
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  int partly_outside = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec3 a(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
    const Vec3 b(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
    int outside = 0;
    int changes = 0;
    bool was_inside = false;
    for (int s = 0; s < kSamples; ++s) {
      const double t = (s + 0.5) / kSamples;
      const bool is_inside = std::abs(test::winding_number(mesh, (1.0 - t) * a + t * b)) > 0.5;
      outside += is_inside ? 0 : 1;
      changes += is_inside == was_inside ? 0 : 1;
      was_inside = is_inside;
    }
    // Every change is found up to one sample; four spikes may be passed between two samples.
    EXPECT_NEAR(shell.outside_length(0, a, b) / (b - a).norm(),
                static_cast<double>(outside) / kSamples, (changes + 4.0) / kSamples);
    EXPECT_EQ(shell.inside(0, a, b), shell.outside_length(0, a, b) == 0.0);
    partly_outside += outside > 0 && outside < kSamples ? 1 : 0;
  }
  EXPECT_GE(partly_outside, 20);
}

TEST(ShellInside, FacesThatMeetByHundredsAtFewVerticesEncloseNothing) {
  // Each face twice, once each way: every edge has an even number of faces, yet nothing is enclosed.
  TriMesh mesh = test::box(1, 1, 1, 2);
  const auto of_box = static_cast<std::uint32_t>(mesh.positions.size());
  std::vector<std::uint32_t> component(of_box, 0);
  constexpr std::uint32_t kVertices = 30;
  Pcg32 random(11);
  for (std::uint32_t i = 0; i < kVertices; ++i) {
    mesh.positions.emplace_back(random.uniform(), random.uniform(), random.uniform());
    component.push_back(1);
  }
  for (std::uint32_t f = 0; f < 5000; ++f) {
    const std::uint32_t a = f % kVertices;
    const std::uint32_t b = (a + 1 + f / kVertices % 14) % kVertices;
    const std::uint32_t c = (b + 1 + f / 420 % 14) % kVertices;
    if (c != a) {
      mesh.triangles.push_back({of_box + a, of_box + b, of_box + c});
      mesh.triangles.push_back({of_box + a, of_box + c, of_box + b});
    }
  }
  const Shell shell(mesh, component);
  EXPECT_TRUE(shell.is_open(1));
  EXPECT_FALSE(shell.is_open(0)) << "the box beside it";
}

/// A wavy sheet with both sides: no place is between them.
TriMesh paper(int cells) {
  TriMesh mesh = test::sheet(1.0, 1.0, cells);
  for (Vec3& p : mesh.positions) {
    p.z() = 0.1 * std::sin(3.0 * p.x()) * std::cos(2.0 * p.y());
  }
  const std::size_t count = mesh.triangles.size();
  for (std::size_t f = 0; f < count; ++f) {
    const auto [a, b, c] = mesh.triangles[f];
    mesh.triangles.push_back({b, a, c});
  }
  return mesh;
}

TEST(ShellInside, OfPaperWithTwoSidesIsNowhere) {
  for (const double scale : {1e-20, 1.0, 1e20}) {
    TriMesh mesh = paper(12);
    for (Vec3& p : mesh.positions) {
      p *= scale;
    }
    const auto component = one_component(mesh);
    EXPECT_TRUE(Shell(mesh, component).is_open(0)) << scale;
  }
}

TEST(ShellInside, OfACubeIsThereHoweverItsFacesAreWound) {
  TriMesh mesh = test::box(1.0, 1.0, 1.0, 2);
  // Every other face turned: what the volumes add up to tells nothing.
  for (std::size_t f = 0; f < mesh.triangles.size(); f += 2) {
    std::swap(mesh.triangles[f][0], mesh.triangles[f][1]);
  }
  const auto component = one_component(mesh);
  EXPECT_FALSE(Shell(mesh, component).is_open(0));
}

TEST(ShellInside, OfPlacesThatAreNoNumbersEnds) {
  const TriMesh mesh = test::torus(1.0, 0.3, 20, 10);
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  const Vec3 far = Vec3::Constant(std::numeric_limits<double>::infinity());
  for (const Vec3& p : {nowhere, far, Vec3(-far)}) {
    EXPECT_FALSE(shell.inside(0, p));
    EXPECT_FALSE(shell.inside(0, Vec3::Zero(), p));
    static_cast<void>(shell.outside_length(0, p, Vec3::Zero()));
  }
}

TEST(ShellInside, OfABoxWhoseAreasHaveNoSquaresEnds) {
  TriMesh mesh = test::box(1, 2, 3, 3);
  for (Vec3& p : mesh.positions) {
    p *= 1e100;
  }
  const auto components = one_component(mesh);
  const Shell shell(mesh, components);
  const Vec3 middle = bounding_box(mesh.positions).low + 0.5 * bounding_box(mesh.positions).size();
  EXPECT_TRUE(shell.inside(0, middle));
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    static_cast<void>(shell.wall_at(v));
  }
}

}  // namespace
}  // namespace vantage
