// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "vantage/pipeline/find_views.h"

#include "support/model_of.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

/// A cone that stands on z = 0 and points to +z.
TriMesh cone() {
  TriMesh mesh = cylinder(1.0, 2.0, 32, 4);
  for (Vec3& p : mesh.positions) {
    p.x() *= 1.0 - 0.45 * p.z();
    p.y() *= 1.0 - 0.45 * p.z();
  }
  return mesh;
}

UpChoice choice_for(const TriMesh& mesh, ModelFormat format, const ViewOptions& options = {}) {
  Model model = model_of(mesh);
  model.format = format;
  return choose_up(model, prepare_surface(model), options);
}

TEST(UpChoice, IsWhatTheModelStandsOnAndSaysSo) {
  const UpChoice up = choice_for(cone(), ModelFormat::Ply);
  EXPECT_EQ(up.axis, UpAxis::Z);
  EXPECT_EQ(up.source, "stance");
  EXPECT_NE(up.note.find("--up y"), std::string::npos);
}

TEST(UpChoice, OfAnStlMayBeY) {
  const double quarter = -0.5 * std::numbers::pi;  // turns z to y
  const TriMesh y_up = moved(cone(), 1.0, quarter, Vec3::UnitX(), Vec3::Zero());
  EXPECT_EQ(choice_for(y_up, ModelFormat::Stl).axis, UpAxis::Y);
  EXPECT_EQ(choice_for(cone(), ModelFormat::Stl).source, "format");
}

TEST(UpChoice, IsTheFormatsWhenBothWaysStand) {
  const UpChoice up = choice_for(box(1.0, 2.0, 3.0, 4), ModelFormat::Ply);
  EXPECT_EQ(up.axis, UpAxis::Y);
  EXPECT_EQ(up.source, "format");
  EXPECT_EQ(up.note, "");
}

TEST(UpChoice, IsTheFormatsForGltfWhateverTheStance) {
  EXPECT_EQ(choice_for(cone(), ModelFormat::Glb).axis, UpAxis::Y);
  EXPECT_EQ(choice_for(cone(), ModelFormat::Gltf).axis, UpAxis::Y);
}

TEST(UpChoice, IsTheUsersWhateverTheStance) {
  ViewOptions options;
  options.up = UpAxis::MinusX;
  const UpChoice up = choice_for(cone(), ModelFormat::Ply, options);
  EXPECT_EQ(up.axis, UpAxis::MinusX);
  EXPECT_EQ(up.source, "given");
}

}  // namespace
}  // namespace vantage::test
