// SPDX-License-Identifier: MIT
#include "spatial/face_clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "spatial/picture_cells.h"
#include "support/random_soup.h"
#include "support/shapes.h"
#include "visibility/sample_query.h"
#include "visibility/surface.h"

namespace vantage {
namespace {

const Viewpoint kAbove{Projection::Orthographic, Vec3(0.0, 0.0, 1.0)};
constexpr std::size_t kEnough = 100'000'000;  // steps

/// What FaceClip says of a mesh that hides with both sides.
class Clipped {
 public:
  Clipped(const TriMesh& mesh, const Viewpoint& eye)
      : scene_(visibility_surface(mesh, sides_)), local_(eye_in_frame(eye, surface_.frame)) {
    for (std::size_t f = 0; f < surface_.faces.size(); ++f) {
      const double height =
          surface_.area_vectors[f].dot(sight_line(surface_.samples[surface_.faces[f][0]], local_));
      turned_.push_back(height > 0.0 ? 1 : height < 0.0 ? 2 : 0);
    }
  }

  /// Of each face of the mesh.
  [[nodiscard]] std::vector<double> shares() const {
    std::vector<double> result(surface_.faces.size(), 0.0);
    FaceClip clip;
    clip.begin(surface_.samples, surface_.faces, local_);
    for (std::uint32_t f = 0; f < result.size(); ++f) {
      std::size_t steps = 0;
      EXPECT_TRUE(add_shadows(f, clip) || clip.subtract(steps, kEnough));
      for (std::size_t i = 0; i < clip.parts().size(); ++i) {
        result[surface_.face_of_mesh[f]] += twice_area(clip.parts()[i]);
      }
    }
    return result;
  }

  /// Whether so many steps are enough to clip a face.
  [[nodiscard]] bool is_clipped(std::uint32_t face, std::size_t steps) const {
    FaceClip clip;
    clip.begin(surface_.samples, surface_.faces, local_);
    add_shadows(number_of(face), clip);
    std::size_t taken = 0;
    return clip.subtract(taken, steps);
  }

  /// Whether an edge lies before a face of the mesh, or in it; the edge by its ends' positions.
  [[nodiscard]] bool is_behind(std::uint32_t face, const Vec3& a, const Vec3& b) const {
    FaceClip clip;
    clip.begin(surface_.samples, surface_.faces, local_);
    take(number_of(face), clip);
    return clip.is_behind({sample(a), sample(b)});
  }

  /// The shares of the parts of a face of the mesh that is cut along edges, ascending.
  [[nodiscard]] std::vector<double> areas_along(
      std::uint32_t face, const std::vector<std::array<Vec3, 2>>& edges) const {
    FaceClip clip;
    clip.begin(surface_.samples, surface_.faces, local_);
    take(number_of(face), clip);
    for (const auto& [a, b] : edges) {
      clip.cut_along({sample(a), sample(b)});
    }
    std::vector<double> areas;
    for (std::size_t i = 0; i < clip.parts().size(); ++i) {
      areas.push_back(twice_area(clip.parts()[i]));
    }
    std::sort(areas.begin(), areas.end());
    return areas;
  }

  /// The side that a face of the mesh turns to the eye.
  [[nodiscard]] int turned(std::uint32_t face) const { return turned_[number_of(face)]; }

  /// The same from the centroids of squared `side` parts of each face.
  [[nodiscard]] std::vector<double> sampled_shares(int side) {
    std::vector<double> result(surface_.faces.size(), 0.0);
    for (std::uint32_t f = 0; f < result.size(); ++f) {
      const auto& [a, b, c] = surface_.faces[f];
      int seen = 0;
      for (int i = 0; i < side; ++i) {
        for (int j = 0; j < 2 * (side - i) - 1; ++j) {
          const double third = (j % 2 + 1.0) / 3.0;
          const double u = (i + third) / side;
          const int row = j / 2;
          const double v = (row + third) / side;
          const Vec3 place = u * surface_.samples[a] + v * surface_.samples[b] +
                             (1.0 - u - v) * surface_.samples[c];
          seen += scene_.hides_place(place, f, local_) ? 0 : 1;
        }
      }
      result[surface_.face_of_mesh[f]] = static_cast<double>(seen) / (side * side);
    }
    return result;
  }

 private:
  /// \return whether one of them hides all of the face, of which nothing is left then.
  void take(std::uint32_t face, FaceClip& clip) const {
    clip.take(face, surface_.area_vectors[face] / surface_.twice_areas[face]);
  }

  bool add_shadows(std::uint32_t face, FaceClip& clip) const {
    take(face, clip);
    bool is_hidden = false;
    for (std::uint32_t other = 0; other < surface_.faces.size(); ++other) {
      is_hidden = (other != face && clip.add_shadow(other)) || is_hidden;
    }
    if (is_hidden) {
      std::size_t steps = 0;
      EXPECT_TRUE(clip.subtract(steps, kEnough));
      EXPECT_EQ(clip.parts().size(), 0U);
    }
    return is_hidden;
  }

  [[nodiscard]] std::uint32_t sample(const Vec3& place) const {
    const Vec3 there = surface_.frame.to_frame(place);
    const auto at = std::find(surface_.samples.begin(), surface_.samples.end(), there);
    EXPECT_NE(at, surface_.samples.end());
    return static_cast<std::uint32_t>(at - surface_.samples.begin());
  }

  [[nodiscard]] std::uint32_t number_of(std::uint32_t face) const {
    const auto at = std::find(surface_.face_of_mesh.begin(), surface_.face_of_mesh.end(), face);
    return static_cast<std::uint32_t>(at - surface_.face_of_mesh.begin());
  }

  std::vector<FaceSides> sides_{FaceSides::Both};
  SampleScene scene_;
  const Surface& surface_ = scene_.surface();
  Viewpoint local_;
  std::vector<std::uint8_t> turned_{};
};

TEST(FaceClip, LeavesWhatIsBesideAPlate) {
  // A sheet of 4 × 4 under a narrower one that leaves a slit of 1e-7 of it.
  const double slit = 4e-7;
  const TriMesh mesh = test::together(test::sheet(4.0, 4.0, 1), test::sheet(4.0 - slit, 4.0, 1),
                                      Vec3(0.0, 0.0, 1.0));
  const std::vector<double> shares = Clipped(mesh, kAbove).shares();
  ASSERT_EQ(shares.size(), 4U);
  EXPECT_NEAR(shares[0] + shares[1], 2e-7, 1e-13);
  EXPECT_NEAR(shares[2] + shares[3], 2.0, 1e-14);
}

TEST(FaceClip, LeavesWhatLiesBeforeAFaceThatPassesThrough) {
  // The slope rises through the sheet along a line in its middle and covers all of it.
  TriMesh slope = test::sheet(4.0, 4.0, 1);
  for (Vec3& p : slope.positions) {
    p.z() = p.x() - 2.0;
  }
  const TriMesh mesh = test::together(test::sheet(4.0, 4.0, 1), slope, Vec3::Zero());
  for (const double height : {5.0, 50.0}) {
    const std::vector<double> shares =
        Clipped(mesh, {Projection::Perspective, Vec3(2.0, 2.0, height)}).shares();
    EXPECT_NEAR(shares[0] + shares[1], 1.0, 1e-13);
    // What is seen of the slope is in the picture the other half.
    EXPECT_NEAR(shares[2] + shares[3], 1.0, 1e-13);
  }
}

TEST(FaceClip, LeavesFacesBesideEachOtherWhole) {
  for (const Projection projection : {Projection::Orthographic, Projection::Perspective}) {
    const Clipped sphere(test::sphere(2), {projection, Vec3(3.0, 2.0, 4.0)});
    const std::vector<double> shares = sphere.shares();
    for (std::uint32_t f = 0; f < shares.size(); ++f) {
      EXPECT_NEAR(shares[f], sphere.turned(f) == 1 ? 1.0 : 0.0, 1e-12);
    }
  }
}

TEST(FaceClip, GivesUpAfterAsManySteps) {
  const Clipped clipped(
      test::together(test::sheet(4.0, 4.0, 1), test::sheet(1.0, 1.0, 8), Vec3(1.0, 1.0, 1.0)),
      kAbove);
  EXPECT_FALSE(clipped.is_clipped(0, 10));
  EXPECT_TRUE(clipped.is_clipped(0, 100'000));
}

TEST(FaceClip, KeepsWhatShadowsPassByInOnePart) {
  TriMesh mesh = test::sheet(4.0, 4.0, 1);
  mesh = test::together(mesh, test::sheet(1.0, 1.0, 1), Vec3(-1.0, -1.0, 1.0));
  const std::vector<double> shares = Clipped(mesh, kAbove).shares();
  EXPECT_EQ(shares[0], 1.0);
  EXPECT_EQ(shares[1], 1.0);
}

TEST(FaceClip, LeavesWhatSamplesSee) {
  for (const Viewpoint& eye : {Viewpoint{Projection::Orthographic, Vec3(0.3, -0.2, 1.0)},
                               Viewpoint{Projection::Perspective, Vec3(3.0, 2.0, 4.0)}}) {
    Clipped clipped(test::random_soup(60, 7), eye);
    const std::vector<double> exact = clipped.shares();
    const std::vector<double> sampled = clipped.sampled_shares(40);
    double sum = 0.0;
    for (std::size_t f = 0; f < exact.size(); ++f) {
      EXPECT_NEAR(exact[f], sampled[f], 0.03);  // an edge across it, of 1600 parts
      sum += exact[f] - sampled[f];
    }
    EXPECT_NEAR(sum / static_cast<double>(exact.size()), 0.0, 1e-3);
  }
}

TEST(FaceClip, LosesAShadowThatBeginsOnItsSide) {
  // But for rounding: then two of the shadow's corners are one.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.1, 0.8);
  for (int i = 0; i < 300; ++i) {
    const Vec3 eye(4.0 * share(random), 4.0 * share(random), 5.0 + share(random));
    TriMesh mesh;
    mesh.positions = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    const std::array shadow{Vec3(4.0 * share(random), 0.0, 0.0),
                            Vec3(2.0 * share(random), 1.5, 0.0),
                            Vec3(2.0 * share(random), 2.0 * share(random), 0.0)};
    for (const Vec3& place : shadow) {
      mesh.positions.push_back(eye + share(random) * (place - eye));
    }
    const double area = 0.5 * (shadow[1] - shadow[0]).cross(shadow[2] - shadow[0]).norm();
    EXPECT_NEAR(Clipped(mesh, {Projection::Perspective, eye}).shares()[0], 1.0 - area / 8.0, 1e-9);
  }
}

TEST(FaceClip, IsCutAlongEdgesAsFarAsTheyPassBeforeIt) {
  // The face's first two barycentric coordinates are 1 − (x + y) / 4 and x / 4.
  TriMesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0),  Vec3(1, -1, 1),
                    Vec3(1, 1, 1), Vec3(3, 2, 1), Vec3(-1, 1, 1), Vec3(9, 9, 1)};
  mesh.triangles = {{0, 1, 2}, {3, 4, 7}, {4, 5, 7}, {6, 3, 7}};
  const Clipped clipped(mesh, kAbove);
  const auto areas_along = [&](const std::vector<std::array<std::size_t, 2>>& edges) {
    std::vector<std::array<Vec3, 2>> places;
    for (const auto& [a, b] : edges) {
      places.push_back({mesh.positions[a], mesh.positions[b]});
    }
    return clipped.areas_along(0, places);
  };
  EXPECT_EQ(areas_along({}), std::vector<double>{1.0});
  EXPECT_EQ(areas_along({{6, 3}}), std::vector<double>{1.0});  // through its corner alone
  // The line x = 1 leaves a triangle of 9/16, though the edge ends on its way.
  EXPECT_EQ(areas_along({{3, 4}}), (std::vector<double>{7.0 / 16.0, 9.0 / 16.0}));
  // An edge on from there cuts the part that it passes before, not the other.
  const std::vector<double> both = areas_along({{3, 4}, {4, 5}});
  ASSERT_EQ(both.size(), 3U);
  EXPECT_EQ(both[2], 7.0 / 16.0);
  EXPECT_NEAR(both[0] + both[1] + both[2], 1.0, 1e-15);
}

TEST(FaceClip, LiesBehindEdgesThatRiseFromItsCornersNotBehindThoseThatSink) {
  // A face seen from above, and others with an edge from its first corner to over or under its middle.
  TriMesh mesh;
  mesh.positions = {Vec3(0, 0, 0),   Vec3(4, 0, 0),      Vec3(0, 4, 0),
                    Vec3(1, 1, 0.5), Vec3(1, 1.2, -0.5), Vec3(1.2, 1, -1e-3),
                    Vec3(5, 5, 0.1), Vec3(1.5, 1, 0.0),  Vec3(-1, -1, 0.0)};
  mesh.triangles = {{0, 1, 2}, {0, 3, 6}, {0, 4, 6}, {0, 5, 6}, {0, 7, 6}, {3, 8, 6}};
  const Clipped clipped(mesh, kAbove);
  const auto is_behind = [&](std::size_t a, std::size_t b) {
    EXPECT_EQ(clipped.is_behind(0, mesh.positions[a], mesh.positions[b]),
              clipped.is_behind(0, mesh.positions[b], mesh.positions[a]));
    return clipped.is_behind(0, mesh.positions[a], mesh.positions[b]);
  };
  EXPECT_TRUE(is_behind(0, 3));
  EXPECT_FALSE(is_behind(0, 4));
  EXPECT_FALSE(is_behind(0, 5));
  EXPECT_TRUE(is_behind(0, 7));  // in it
  EXPECT_TRUE(is_behind(3, 8));
  EXPECT_FALSE(is_behind(4, 8));
}

}  // namespace
}  // namespace vantage
