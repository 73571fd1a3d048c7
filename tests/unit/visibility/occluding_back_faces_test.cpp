// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/spatial/directions.h"
#include "vantage/visibility/face_visibility.h"
#include "vantage/visibility/vertex_visibility.h"

#include "spatial/face_meetings.h"
#include "support/shapes.h"
#include "support/voxel_surface.h"
#include "visibility/surface.h"

namespace vantage {
namespace {

/// Faces whose back_faces are to be asked, and all faces.
struct Count {
  std::size_t asked = 0, all = 0;

  bool operator==(const Count&) const = default;
};

Count backs_of(const TriMesh& mesh) {
  const std::vector<FaceSides> sides{FaceSides::Front};
  const Surface surface = visibility_surface(mesh, sides);
  const TriMesh framed{surface.samples, surface.faces};
  const auto asked = find_meetings(framed, surface_edges(framed)).occluding_back_faces;
  return {static_cast<std::size_t>(std::count(asked.begin(), asked.end(), 1)), asked.size()};
}

/// A unit box whose top is drawn in to a point below its middle; beyond the bottom the funnel is an
/// inside-out pocket.
TriMesh funnel(double depth, const Vec3& aside = Vec3::Zero()) {
  TriMesh mesh = test::box(1.0, 1.0, 1.0, 2);
  for (Vec3& p : mesh.positions) {
    if (p == Vec3(0.5, 0.5, 1.0)) {
      p = Vec3(0.5, 0.5, 1.0 - depth) + aside;
    }
  }
  return mesh;
}

/// Whether what seen_surface() leaves out of its walk changes no vertex from any of these eyes.
void expect_no_change(const TriMesh& mesh, const std::vector<FaceSides>& sides) {
  const FaceVisibility visibility(mesh, sides);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vec3 place(x, 2 * y, z);
        for (const Viewpoint& eye : {Viewpoint{Projection::Orthographic, place},
                                     Viewpoint{Projection::Perspective, 4.0 * place},
                                     Viewpoint{Projection::Perspective, 0.31 * place}}) {
          if (x != 0 || y != 0 || z != 0) {
            ASSERT_EQ(visibility.seen_surface(eye).vertices, visibility.visible_vertices(eye))
                << place.transpose();
          }
        }
      }
    }
  }
}

/// Whether it makes no difference to know about many eyes.
void expect_same_for_many(const TriMesh& mesh, const std::vector<FaceSides>& sides) {
  const VertexVisibility one(mesh, sides);
  const VertexVisibility many(mesh, sides, 1000);
  for (const Vec3& towards : direction_set(ViewSphereBase::Icosahedron, 2).directions) {
    for (const Viewpoint& eye : {Viewpoint{Projection::Orthographic, towards},
                                 Viewpoint{Projection::Perspective, 5.0 * towards},
                                 Viewpoint{Projection::Perspective, 0.4 * towards}}) {
      ASSERT_EQ(one.visible_vertices(eye), many.visible_vertices(eye)) << towards.transpose();
    }
  }
}

TEST(HidingBacks, AreNoneOfShellsThatAreClosedAndOutward) {
  EXPECT_EQ(backs_of(test::box(1.0, 2.0, 3.0, 2)).asked, 0U);
  EXPECT_EQ(backs_of(test::torus(1.0, 0.3, 20, 12)).asked, 0U);
  EXPECT_EQ(backs_of(test::soup(test::sphere(2))).asked, 0U);
  EXPECT_EQ(backs_of(test::plate_with_holes(3)).asked, 0U);
  EXPECT_EQ(backs_of(funnel(0.5)).asked, 0U);
}

TEST(HidingBacks, AreAllOfShellsThatAreOpenOrInsideOut) {
  EXPECT_EQ(backs_of(test::sheet(1.0, 1.0, 3)), (Count{18, 18}));
  EXPECT_EQ(backs_of(test::inside_out(test::box(1.0, 1.0, 1.0, 1))), (Count{12, 12}));
}

TEST(HidingBacks, AreCountedShellByShell) {
  const TriMesh box = test::box(1.0, 1.0, 1.0, 1);
  // Shells that pass through each other are none the worse for it.
  EXPECT_EQ(backs_of(test::together(box, box, Vec3(0.5, 0.4, 0.3))), (Count{0, 24}));
  EXPECT_EQ(backs_of(test::together(box, test::inside_out(box), Vec3(3.0, 0.0, 0.0))),
            (Count{12, 24}));
}

/// A bar bent to a ring so far that one end lies in the other.
TriMesh ring_through_itself() {
  TriMesh mesh = test::box(12.0, 1.0, 1.0, 12);
  for (Vec3& p : mesh.positions) {
    const double angle = -0.56 * p.x();  // more than once around
    const double radius = 3.0 + p.y();
    p = Vec3(radius * std::cos(angle), radius * std::sin(angle), p.z() + 0.03 * p.x());
  }
  return mesh;
}

TEST(HidingBacks, AreThoseOfAPocketAndOfWhatIsCrossed) {
  // Edges pass through faces, and, straight below, exactly through edges and the corner between: all
  // eight faces of the funnel and four of the bottom are crossed.
  EXPECT_EQ(backs_of(funnel(1.5, Vec3(0.1, 0.03, 0.0))), (Count{12, 48}));
  EXPECT_EQ(backs_of(funnel(2.0)), (Count{12, 48}));
  EXPECT_EQ(backs_of(funnel(1.0, Vec3(0.1, 0.03, 0.0))), (Count{7, 48}));  // a touch
  EXPECT_EQ(backs_of(funnel(1.0)), (Count{0, 48}));  // corners that are one enclose nothing
  // Inside out, its pocket is the right way around, and all else is not.
  EXPECT_EQ(backs_of(test::inside_out(funnel(1.5, Vec3(0.1, 0.03, 0.0)))), (Count{48, 48}));
}

/// A unit box whose top but for a rim is pushed down through its bottom: the floor of this well, which
/// nothing crosses, has an inside-out room above it.
TriMesh well_through_the_bottom() {
  TriMesh mesh = test::box(1.0, 1.0, 1.0, 6);
  for (Vec3& p : mesh.positions) {
    const bool is_inner = std::abs(p.x() - 0.5) < 0.4 && std::abs(p.y() - 0.5) < 0.4;
    if (is_inner && p.z() == 1.0) {
      p = Vec3(p.x() + 0.01, p.y() + 0.02, -0.2);
    }
  }
  return mesh;
}

TEST(HidingBacks, AreThoseOfAFloorThatNothingCrosses) {
  const TriMesh well = well_through_the_bottom();
  const Surface surface = visibility_surface(well, std::vector<FaceSides>{FaceSides::Front});
  const TriMesh framed{surface.samples, surface.faces};
  const FaceMeetings meetings = find_meetings(framed, surface_edges(framed));
  std::size_t floor = 0;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Triangle& corners = well.triangles[surface.face_of_mesh[f]];
    if (std::all_of(corners.begin(), corners.end(),
                    [&](std::uint32_t v) { return well.positions[v].z() == -0.2; })) {
      ++floor;
      EXPECT_EQ(meetings.crossed[f], 0) << f;
      EXPECT_EQ(meetings.occluding_back_faces[f], 1) << f;
    }
  }
  EXPECT_EQ(floor, 32U);
  expect_same_for_many(well, {FaceSides::Front});
  expect_no_change(well, {FaceSides::Front});
}

TEST(HidingBacks, AreOnlyThoseThatAreCrossedWhereLimbsPassThroughEachOther) {
  const TriMesh ring = ring_through_itself();
  const Count backs = backs_of(ring);
  EXPECT_GT(backs.asked, 0U);
  EXPECT_LT(4 * backs.asked, backs.all);
  expect_no_change(ring, {FaceSides::Front});
  expect_same_for_many(ring, {FaceSides::Front});
}

TEST(HidingBacks, OfAPocketHideWhatNoFrontHides) {
  const FaceVisibility visibility(funnel(1.5, Vec3(0.1, 0.03, 0.0)), {FaceSides::Front});
  const auto seen =
      visibility.seen_surface({Projection::Orthographic, Vec3(0.0, 0.0, -1.0)}).vertices;
  const TriMesh mesh = funnel(1.5, Vec3(0.1, 0.03, 0.0));
  for (std::size_t v = 0; v < seen.size(); ++v) {
    if (mesh.positions[v] == Vec3(0.5, 0.5, 0.0)) {
      EXPECT_EQ(seen[v], 0);  // inside the pocket, whose back_faces are all that is below it
    }
  }
}

TEST(HidingBacks, AreAllOfWhatIsTooCrowdedToLookAt) {
  // Closed needles side by side, in one box all of them: every face is near every other.
  const auto needles = [](int count) {
    TriMesh all;
    for (int i = 0; i < count; ++i) {
      TriMesh needle = test::box(1.0, 1e-4, 1e-4, 1);
      for (Vec3& p : needle.positions) {
        p = Vec3(p.x(), p.x() + p.y() + 1e-3 * i, p.x() + p.z());
      }
      all = test::together(all, needle, Vec3::Zero());
    }
    return all;
  };
  EXPECT_EQ(backs_of(needles(5)), (Count{0, 60}));
  EXPECT_EQ(backs_of(needles(60)), (Count{720, 720}));
}

TEST(HidingBacks, AreLeftOutForManyEyesAndChangeNothing) {
  expect_same_for_many(test::torus(1.0, 0.3, 60, 30), {FaceSides::Front});
  expect_same_for_many(funnel(0.5), {FaceSides::Front});
  expect_same_for_many(funnel(1.5, Vec3(0.1, 0.03, 0.0)), {FaceSides::Front});
  expect_same_for_many(test::inside_out(test::box(1.0, 1.0, 1.0, 3)), {FaceSides::Front});
  expect_same_for_many(test::together(test::torus(1.0, 0.3, 24, 12), test::sheet(2.0, 2.0, 5),
                                      Vec3(-1.0, -1.0, 0.1)),
                       {FaceSides::Front, FaceSides::Both});
  expect_same_for_many({}, {FaceSides::Front});
}

TEST(HidingBacks, AreAllThatMatter) {
  expect_no_change(test::box(1.0, 2.0, 1.0, 3), {FaceSides::Front});
  expect_no_change(test::torus(1.0, 0.3, 24, 12), {FaceSides::Front});
  expect_no_change(test::plate_with_holes(3), {FaceSides::Front});
  expect_no_change(test::cube_frame(), {FaceSides::Front});
  expect_no_change(test::inside_out(test::box(1.0, 1.0, 1.0, 3)), {FaceSides::Front});
  expect_no_change(funnel(0.9), {FaceSides::Front});
  expect_no_change(funnel(1.5, Vec3(0.1, 0.03, 0.0)), {FaceSides::Front});
  expect_no_change(test::together(test::torus(1.0, 0.3, 24, 12), test::sheet(2.0, 2.0, 5),
                                  Vec3(-1.0, -1.0, 0.1)),
                   {FaceSides::Front, FaceSides::Both});
}

}  // namespace
}  // namespace vantage
