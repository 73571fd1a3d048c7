// SPDX-License-Identifier: MIT
#include <ctime>

#include <gtest/gtest.h>

#include "vantage/io/model.h"

namespace vantage::test {
namespace {

TEST(MakeVisible, LooksThroughATextureOnceForAllFacesWithoutCoordinates) {
  Appearance appearance;
  appearance.textures.push_back(
      {Image{1024, 1024, std::vector<std::uint8_t>(std::size_t{4} << 20U)}});
  appearance.materials.resize(1);
  appearance.materials[0].alpha = AlphaMode::Mask;
  appearance.materials[0].texture = 0;
  appearance.material_of_triangle.assign(100'000, 0U);
  const std::clock_t begin = std::clock();
  EXPECT_TRUE(make_visible(appearance));
  // Thousandths of a second; where each face looks through the texture anew, nine seconds.
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 1.0);
  EXPECT_EQ(appearance.materials[0].alpha, AlphaMode::Opaque);
}

}  // namespace
}  // namespace vantage::test
