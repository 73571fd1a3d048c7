// SPDX-License-Identifier: MIT
#include "vantage/orientation/orientation.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"

#include "support/shapes.h"

namespace vantage::test {
namespace {

/// A chair: a seat on four legs, a back at −y; it stands on z = 0 and faces +y.
TriMesh chair() {
  TriMesh mesh;
  mesh = together(mesh, box(1.0, 1.0, 0.1, 4), {0.0, 0.0, 0.9});
  mesh = together(mesh, box(1.0, 0.1, 1.0, 4), {0.0, 0.0, 1.0});
  for (const double x : {0.0, 0.9}) {
    for (const double y : {0.0, 0.9}) {
      mesh = together(mesh, box(0.1, 0.1, 0.9, 1), {x, y, 0.0});
    }
  }
  return mesh;
}

/// The 24 rotations that take axes to axes.
std::vector<Eigen::Matrix3d> axis_rotations() {
  std::vector<Eigen::Matrix3d> rotations;
  for (int first = 0; first < 6; ++first) {
    for (int second = 0; second < 6; ++second) {
      if (first % 3 != second % 3) {
        const Vec3 x = Vec3::Unit(first % 3) * (first < 3 ? 1.0 : -1.0);
        const Vec3 y = Vec3::Unit(second % 3) * (second < 3 ? 1.0 : -1.0);
        Eigen::Matrix3d matrix;
        matrix << x, y, x.cross(y);
        rotations.push_back(matrix);
      }
    }
  }
  return rotations;
}

TriMesh turned(TriMesh mesh, const Eigen::Matrix3d& rotation) {
  for (Vec3& p : mesh.positions) {
    p = rotation * p;
  }
  return mesh;
}

/// What speaks for a direction as up.
std::vector<OrientationFeature> evidence_for(const OrientationEvidence& evidence, const Vec3& up) {
  for (const OrientationFeatures& row : evidence.features()) {
    if (row.up == up) {
      return row.values;
    }
  }
  return {};
}

TEST(Orientation, OfAChairTurnsWithIt) {
  const OrientationEvidence plain(chair());
  const Vec3 up = plain.find({.usual_up = Vec3::UnitZ()}).up.direction;
  EXPECT_EQ(up, Vec3::UnitZ());
  const std::vector<OrientationFeature> values = evidence_for(plain, up);
  EXPECT_EQ(axis_rotations().size(), 24U);
  for (const Eigen::Matrix3d& rotation : axis_rotations()) {
    // The convention's up turns along.
    const OrientationEvidence turned_too(turned(chair(), rotation));
    EXPECT_EQ(turned_too.find({.usual_up = rotation * Vec3::UnitZ()}).up.direction, rotation * up);
    const std::vector<OrientationFeature> found = evidence_for(turned_too, rotation * up);
    ASSERT_EQ(found.size(), values.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_EQ(found[k].name, values[k].name);
      EXPECT_NEAR(found[k].value, values[k].value, 1e-9) << found[k].name;
    }
  }
}

TEST(Orientation, DoesNotDependOnUnitAndOrder) {
  const TriMesh mesh = chair();
  const OrientationRequest request{.usual_up = Vec3::UnitY()};
  const Orientation plain = OrientationEvidence(mesh).find(request);
  const Orientation other =
      OrientationEvidence(moved(renumbered(mesh, 3), 256.0, 0.0, Vec3::UnitX(), Vec3::Zero()))
          .find(request);
  EXPECT_EQ(other.up.direction, plain.up.direction);
  EXPECT_EQ(other.front.direction, plain.front.direction);
  EXPECT_NEAR(other.up.confidence, plain.up.confidence, 1e-9);
}

TEST(Orientation, DoesNotDependOnWhichFacesOfAnEdgeComeFirst) {
  TriMesh fins = box(1.0, 1.0, 1.0, 1);  // and four sheets that meet along one line
  const auto first = static_cast<std::uint32_t>(fins.positions.size());
  for (const Vec3& p : {Vec3(2, 0, 0), Vec3(2, 0, 1), Vec3(3, 0, 0), Vec3(1.5, 0, 1), Vec3(2, 1, 0),
                        Vec3(2, -1, 1)}) {
    fins.positions.push_back(p);
  }
  fins.triangles.push_back({first, first + 1, first + 2});
  fins.triangles.push_back({first + 1, first, first + 3});  // goes on straight
  fins.triangles.push_back({first, first + 1, first + 4});
  fins.triangles.push_back({first + 1, first, first + 5});
  const std::vector<OrientationFeature> values =
      evidence_for(OrientationEvidence(fins), Vec3::UnitZ());
  for (std::size_t last = fins.triangles.size() - 3; last < fins.triangles.size(); ++last) {
    TriMesh other = fins;
    std::swap(other.triangles[last], other.triangles[fins.triangles.size() - 4]);
    const std::vector<OrientationFeature> found =
        evidence_for(OrientationEvidence(other), Vec3::UnitZ());
    for (std::size_t k = 0; k < values.size(); ++k) {
      EXPECT_NEAR(found[k].value, values[k].value, 1e-9) << found[k].name << " " << last;
    }
  }
}

TEST(Orientation, OfWhatLooksTheSameFromAllSidesIsTheFormats) {
  const Orientation of_cube =
      OrientationEvidence(box(1.0, 1.0, 1.0, 4)).find({.usual_up = Vec3::UnitY()});
  EXPECT_EQ(of_cube.up.direction, Vec3::UnitY());
  EXPECT_EQ(of_cube.up.source, "format");
  EXPECT_NEAR(of_cube.up.confidence, 1.0, 1e-12);
  EXPECT_EQ(of_cube.front.direction, Vec3::UnitZ());
  EXPECT_EQ(of_cube.front.source, "format");
}

/// A square seat, y up, with a back along −z that is so thin that a quarter of a turn changes little.
TEST(Orientation, OfASquareSeatWithAThinBackIsNotItsSide) {
  TriMesh seat = box(1.0, 0.1, 1.0, 1);
  seat = together(seat, box(1.0, 1.0, 0.1, 1), {0.0, 0.1, 0.0});
  const Orientation found = OrientationEvidence(seat).find({});
  EXPECT_EQ(found.up.direction, Vec3::UnitY());
  EXPECT_EQ(found.front.direction, Vec3::UnitZ());
  EXPECT_GT(found.front.confidence, 0.5);
}

TEST(Orientation, OfSidesThatLookAlikeHasTheOddsInTheOneThatIsCalledTheFront) {
  // Front and back of the bar look alike, and so do its ends; views weigh what is said of the front.
  const Orientation bar = OrientationEvidence(box(3.0, 1.0, 0.5, 4))
                              .find({.up = Vec3::UnitY(), .usual_up = Vec3::UnitY()});
  EXPECT_NEAR(bar.front_odds[0], bar.front.confidence, 1e-12);
  EXPECT_GT(bar.front_odds[1], 0.0);
  EXPECT_EQ(bar.front_odds[2], 0.0);
  EXPECT_EQ(bar.front_odds[3], 0.0);
  EXPECT_NEAR(bar.front_odds[0] + bar.front_odds[1], 1.0, 1e-12);
  const Orientation cube =
      OrientationEvidence(box(1.0, 1.0, 1.0, 4)).find({.usual_up = Vec3::UnitY()});
  EXPECT_NEAR(cube.front_odds[0], 1.0, 1e-12);
}

TEST(Orientation, OfAShapeThatTellsNoFrontHasTheOddsOfHabit) {
  const TriMesh heap = together(sphere(3), sphere(2), Vec3(0.5, 1.1, 0.7));
  const Orientation usual =
      OrientationEvidence(heap).find({.up = Vec3::UnitY(), .usual_up = Vec3::UnitY()});
  ASSERT_LT(usual.front.likeliest_confidence, 0.5);
  EXPECT_EQ(usual.front.direction, Vec3::UnitZ());
  EXPECT_LT(usual.front.confidence, 0.5);       // what is said of it is the fit's
  EXPECT_NEAR(usual.front_odds[0], 0.65, 0.1);  // what views go by: the share of files that face so
  EXPECT_NEAR(std::accumulate(usual.front_odds.begin(), usual.front_odds.end(), 0.0), 1.0, 1e-12);
  // Files whose up is -y have no usual front.
  const Orientation odd =
      OrientationEvidence(heap).find({.up = -Vec3::UnitY(), .usual_up = Vec3::UnitY()});
  ASSERT_LT(odd.front.likeliest_confidence, 0.5);
  EXPECT_NEAR(odd.front_odds[0], odd.front.confidence, 1e-12);
}

TEST(Orientation, IsCalledNoSurerThanTheFitIsRight) {
  for (const TriMesh& mesh : {chair(), box(1.0, 1.0, 1.0, 3)}) {
    const DirectionChoice up = OrientationEvidence(mesh).find({.usual_up = Vec3::UnitZ()}).up;
    const bool is_cube = mesh.positions.size() != chair().positions.size();
    EXPECT_NEAR(up.confidence, is_cube ? 1.0 : 0.98, 1e-12);
    EXPECT_EQ(up.likeliest_confidence, up.confidence);
  }
}

TEST(Orientation, IsWhatIsGivenOrCertainWhateverTheShape) {
  const OrientationEvidence evidence(chair());
  const Orientation given = evidence.find({.up = -Vec3::UnitX(), .front = Vec3::UnitZ()});
  EXPECT_EQ(given.up.direction, -Vec3::UnitX());
  EXPECT_EQ(given.front.direction, Vec3::UnitZ());
  EXPECT_EQ(given.up.source, "given");
  EXPECT_EQ(given.up.confidence, 1.0);
  const Orientation certain =
      evidence.find({.usual_up = Vec3::UnitY(), .usual_up_is_certain = true});
  EXPECT_EQ(certain.up.direction, Vec3::UnitY());
  EXPECT_EQ(certain.up.source, "format");
  // The front is at right angles to up, and up to a front that is given.
  EXPECT_EQ(certain.front.direction.dot(certain.up.direction), 0.0);
  EXPECT_EQ(evidence.find({.front = Vec3::UnitX()}).up.direction.dot(Vec3::UnitX()), 0.0);
  EXPECT_THROW(
      static_cast<void>(evidence.find(
          {.front = -Vec3::UnitY(), .usual_up = Vec3::UnitY(), .usual_up_is_certain = true})),
      InvalidInput);
}

TEST(Orientation, HasNoUsualFrontWhereUpIsNotUsual) {
  // A chair that stands on x: nothing but the shape speaks of its front.
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(M_PI / 2.0, Vec3::UnitY()).toRotationMatrix();
  const OrientationEvidence evidence(turned(chair(), rotation.array().round().matrix()));
  const DirectionChoice front = evidence.find({.up = Vec3::UnitX()}).front;
  EXPECT_EQ(front.direction, front.likeliest);
}

TEST(Orientation, OfAScanOfOneSideIsTheSideThatWasScanned) {
  // A bump on a sheet that stands upright and looks along -z, turned about y.
  TriMesh scan = sheet(1.0, 1.5, 12);
  for (Vec3& p : scan.positions) {
    const double bump = std::exp(-8.0 * p.head<2>().squaredNorm());
    p.z() = -0.3 * bump;
  }
  const Vec3 normal = area_vector(scan, scan.triangles.front());
  if (normal.z() > 0.0) {
    for (Triangle& t : scan.triangles) {
      std::swap(t[1], t[2]);
    }
  }
  Vec3 front = -Vec3::UnitZ();
  for (int quarter = 0; quarter < 4; ++quarter) {
    const Orientation found = OrientationEvidence(scan).find({.up = Vec3::UnitY()});
    EXPECT_EQ(found.front.direction, front);
    EXPECT_GT(found.front.confidence, 0.9);
    for (Vec3& p : scan.positions) {
      p = {p.z(), p.y(), -p.x()};
    }
    front = {front.z(), front.y(), -front.x()};
  }
}

TEST(Orientation, RefusesDirectionsThatMakeNoFrame) {
  const OrientationEvidence evidence(chair());
  EXPECT_THROW((void)evidence.find({.up = Vec3::UnitX(), .front = -Vec3::UnitX()}), InvalidInput);
  EXPECT_THROW((void)evidence.find({.up = Vec3(1.0, 1.0, 0.0)}), InvalidInput);
}

TEST(Orientation, HasFeaturesOfSixUpsAndTwentyFourFronts) {
  const std::vector<OrientationFeatures> rows = OrientationEvidence(chair()).features();
  ASSERT_EQ(rows.size(), 30U);
  for (const OrientationFeatures& row : rows) {
    std::set<std::string_view> names;
    for (const OrientationFeature& feature : row.values) {
      EXPECT_TRUE(std::isfinite(feature.value)) << feature.name;
      EXPECT_TRUE(names.insert(feature.name).second) << feature.name << " stands twice";
    }
    EXPECT_GT(names.size(), 80U);
  }
}

TEST(Orientation, OfFlatAndTinyShapesIsFinite) {
  TriMesh line;
  line.positions = {Vec3::Zero(), Vec3::UnitX(), Vec3(2.0, 0.0, 0.0)};
  line.triangles = {{0, 1, 2}};
  for (const TriMesh& mesh : {sheet(1.0, 2.0, 3), line}) {
    const Orientation found = OrientationEvidence(mesh).find({});
    EXPECT_TRUE(std::isfinite(found.up.confidence));
    EXPECT_GE(found.front.confidence, 0.0);
    EXPECT_LE(found.front.confidence, 1.0);
  }
}

}  // namespace
}  // namespace vantage::test
