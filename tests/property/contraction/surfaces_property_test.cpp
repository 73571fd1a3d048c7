// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/contraction/contraction.h"

#include "support/named_mesh.h"
#include "support/shapes.h"

/// \file
/// Whole contractions of whole surfaces.

namespace vantage {
namespace {

using test::NamedMesh;

/// A box of long needles, as CAD programs write them: each side is a fan from one of its corners.
TriMesh fanned_box() {
  TriMesh mesh = test::box(2.0, 1.0, 0.5, 1);
  TriMesh fans{.positions = mesh.positions, .triangles = {}};
  for (const Triangle& t : mesh.triangles) {
    std::uint32_t previous = t[1];
    for (int k = 1; k <= 8; ++k) {
      std::uint32_t next = t[2];
      if (k < 8) {
        next = static_cast<std::uint32_t>(fans.positions.size());
        fans.positions.emplace_back(mesh.positions[t[1]] +
                                    k / 8.0 * (mesh.positions[t[2]] - mesh.positions[t[1]]));
      }
      fans.triangles.push_back({t[0], previous, next});
      previous = next;
    }
  }
  return fans;
}

std::vector<NamedMesh> sound_surfaces() {
  return {{"Cube", test::box(1, 1, 1, 1)},       {"CoarseBox", test::box(1, 0.5, 0.25, 2)},
          {"FannedBox", fanned_box()},           {"CoarseTorus", test::torus(1.0, 0.3, 12, 5)},
          {"CoarseY", test::y_of_tubes(0.3, 6)}, {"Plate", test::box(1.0, 1.0, 0.02, 6)},
          {"Sheet", test::sheet(1.0, 0.5, 5)},   {"FineSphere", test::sphere(5)}};
}

class SoundContraction : public ::testing::TestWithParam<NamedMesh> {};

TEST_P(SoundContraction, NeverEnlargesTheSurface) {
  for (const ContractionMethod method : {ContractionMethod::Auto, ContractionMethod::Exact}) {
    const ContractionHistory history = contract(GetParam().mesh, {.method = method});
    ASSERT_GE(history.level_count(), 1U);
    for (std::size_t level = 1; level < history.shrinkage.size(); ++level) {
      EXPECT_LE(history.shrinkage[level], history.shrinkage[level - 1] + 1e-9) << level;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, SoundContraction, ::testing::ValuesIn(sound_surfaces()),
                         [](const auto& instance) { return instance.param.name; });

class Plate : public ::testing::TestWithParam<NamedMesh> {};

/// Their rims become lines that held the rest with 0.3 to 0.7 of its area.
TEST_P(Plate, IsContractedToAThinRest) {
  EXPECT_LE(contract(GetParam().mesh).shrinkage.back(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Plates, Plate,
                         ::testing::Values(NamedMesh{"Square", test::box(1.0, 1.0, 0.02, 20)},
                                           NamedMesh{"Thick", test::box(1.0, 1.0, 0.1, 20)},
                                           NamedMesh{"Lath", test::box(1.0, 0.3, 0.02, 10)},
                                           NamedMesh{"OpenSheet", test::sheet(2.0, 1.0, 60)}),
                         [](const auto& instance) { return instance.param.name; });

TEST(Plates, ContractAlikeWhateverTheirMesh) {
  const ContractionHistory history = contract(test::box(1.0, 1.0, 0.02, 40));
  for (const int cells : {4, 20}) {
    const ContractionHistory other = contract(test::box(1.0, 1.0, 0.02, cells));
    ASSERT_EQ(other.shrinkage.size(), history.shrinkage.size()) << cells;
    for (std::size_t j = 0; j < history.shrinkage.size(); ++j) {
      EXPECT_NEAR(other.shrinkage[j], history.shrinkage[j], 0.01) << cells << ", level " << j;
    }
  }
}

class Caps : public ::testing::TestWithParam<double> {};

TEST_P(Caps, ContractAlikeWhateverTheRotation) {
  const TriMesh mesh = test::sphere_with_caps(GetParam());
  const ContractionHistory plain = contract(mesh);
  for (const double angle : {0.7, 1.1, 2.0, 2.9}) {
    const ContractionHistory other =
        contract(test::moved(mesh, 1.0, angle, Vec3(1, 2, 3), Vec3::Zero()));
    ASSERT_EQ(other.levels.size(), plain.levels.size()) << angle;
    // Rounding of coordinates over `height` is the relative error of the cotangents.
    EXPECT_NEAR(other.shrinkage.back(), plain.shrinkage.back(), 0.05 * plain.shrinkage.back());
  }
}

INSTANTIATE_TEST_SUITE_P(Heights, Caps, ::testing::Values(1e-6, 1e-9), [](const auto& instance) {
  return instance.param < 1e-7 ? "Billionth" : "Millionth";
});

}  // namespace
}  // namespace vantage
