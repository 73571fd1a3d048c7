// SPDX-License-Identifier: MIT
// Pictures of surfaces with materials.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/render/render.h"

#include "core/srgb.h"
#include "render/texture_pyramid.h"
#include "support/shapes.h"

namespace vantage {
namespace {

using testing::ElementsAre;

/// The unit square at z = 0 with a texture from its top left corner, one texture pixel a quarter.
struct Square {
  TriMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  Appearance appearance{};

  explicit Square(std::vector<std::uint8_t> rgba) {
    appearance.textures.push_back(
        {Image{2, 2, std::move(rgba)}, TextureWrap::Clamp, TextureWrap::Clamp, true});
    Material material;
    material.texture = 0;
    material.unlit = true;
    appearance.materials.push_back(material);
    appearance.material_of_triangle = {0, 0};
    appearance.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    appearance.uv_of_triangle = mesh.triangles;
  }
};

Camera before_square(double height = 1.0) {
  Camera camera;
  camera.projection = Projection::Orthographic;
  camera.eye = {0.5, 0.5, 5};
  camera.target = {0.5, 0.5, 0};
  camera.height = height;
  return camera;
}

RenderOptions small(const std::optional<Rgb8>& background = {}) {
  RenderOptions options{.width = 32, .height = 32, .samples = 4};
  options.background = background;
  return options;
}

Image picture(const Square& square, const RenderOptions& options) {
  return render_painted(square.mesh, before_square(), {{}, {}, &square.appearance}, options);
}

std::vector<std::uint8_t> pixel_of(const Image& image, int x, int y) {
  return {image.pixel(x, y), image.pixel(x, y) + 4};
}

constexpr std::uint8_t kOn = 255;

TEST(SurfaceMaterials, DrawsATextureThatIsPlacedBeyondAllNumbers) {
  Square square(std::vector<std::uint8_t>(16, 255));
  square.appearance.textures[0].wrap_u = TextureWrap::Repeat;
  square.appearance.uvs = {{0, 1}, {3, 1}, {3, 0}, {0, 0}};
  square.appearance.materials[0].uv_transform = {1e308, 0, 0, 0, 1e308, 1e308};
  const Image image = picture(square, small());
  EXPECT_EQ(pixel_of(image, 16, 16), (std::vector<std::uint8_t>{255, 255, 255, 255}));
}

TEST(SurfaceMaterials, LaysATextureTheRightWayRound) {
  const Square square({kOn, 0, 0, kOn, 0, kOn, 0, kOn, 0, 0, kOn, kOn, kOn, kOn, kOn, kOn});
  const Image image = picture(square, small());
  EXPECT_THAT(pixel_of(image, 8, 8), ElementsAre(kOn, 0, 0, kOn));
  EXPECT_THAT(pixel_of(image, 24, 8), ElementsAre(0, kOn, 0, kOn));
  EXPECT_THAT(pixel_of(image, 8, 24), ElementsAre(0, 0, kOn, kOn));
  EXPECT_THAT(pixel_of(image, 24, 24), ElementsAre(kOn, kOn, kOn, kOn));
}

TEST(SurfaceMaterials, AWhiteSurfaceWithoutShadeVanishesBeforeWhite) {
  // A furnace: whatever filters, mixes and blends on the way must not gain or lose light.
  for (const AlphaMode mode : {AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend}) {
    Square square({kOn, kOn, kOn, kOn, kOn, kOn, kOn, 128, kOn, kOn, kOn, 77, kOn, kOn, kOn, 0});
    square.appearance.materials[0].alpha = mode;
    for (const double height : {0.3, 1.0, 40.0}) {
      const Image image = render_painted(square.mesh, before_square(height),
                                         {{}, {}, &square.appearance}, small(Rgb8{255, 255, 255}));
      EXPECT_EQ(*std::min_element(image.rgba.begin(), image.rgba.end()), 255) << height;
    }
  }
}

TEST(SurfaceMaterials, HolesShowWhatIsBehind) {
  Square square({kOn, kOn, kOn, kOn, kOn, kOn, kOn, 0, kOn, kOn, kOn, kOn, kOn, kOn, kOn, kOn});
  square.appearance.materials[0].alpha = AlphaMode::Mask;
  const Image image = picture(square, small());
  EXPECT_EQ(image.pixel(8, 8)[3], 255);
  EXPECT_EQ(image.pixel(24, 8)[3], 0);
  // The same hole with a red wall behind it.
  square.mesh = test::together(square.mesh, square.mesh, Vec3(0, 0, -1));
  square.appearance.materials.push_back({.colour = {1.0, 0.0, 0.0}, .unlit = true});
  square.appearance.material_of_triangle = {0, 0, 1, 1};
  square.appearance.uv_of_triangle.resize(4, {0, 1, 2});
  const Image wall = picture(square, small());
  EXPECT_THAT(pixel_of(wall, 24, 8), ElementsAre(kOn, 0, 0, kOn));
  EXPECT_THAT(pixel_of(wall, 8, 8), ElementsAre(kOn, kOn, kOn, kOn));
}

TEST(SurfaceMaterials, AFenceDoesNotVanishInTheDistance) {
  // Bars of 3 of 8 texels, less than any cutoff of their mean would let pass; what is between them is
  // a little opaque, and green.
  Square square({});
  constexpr int kFenceSide = 64;
  for (int i = 0; i < kFenceSide * kFenceSide; ++i) {
    const bool is_bar = i % 8 < 3;
    const std::array<std::uint8_t, 4> texel = is_bar ? std::array<std::uint8_t, 4>{kOn, 0, 0, 200}
                                                     : std::array<std::uint8_t, 4>{0, kOn, 0, 60};
    square.appearance.textures[0].image.rgba.insert(square.appearance.textures[0].image.rgba.end(),
                                                    texel.begin(), texel.end());
  }
  square.appearance.textures[0].image.width = kFenceSide;
  square.appearance.textures[0].image.height = kFenceSide;
  Material& material = square.appearance.materials[0];
  material.alpha = AlphaMode::Mask;
  material.alpha_cutoff = 0.3;  // between the two, 60 and 200 times 0.6 of 255
  material.opacity = 0.6;
  for (const double height : {1.0, 2.0, 4.0, 8.0, 16.0}) {  // 1/2 to 1/32 of a pixel a texel
    const Image image =
        render_painted(square.mesh, before_square(height), {{}, {}, &square.appearance}, small());
    double opacity = 0.0;
    int green = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
      opacity += image.rgba[i + 3] / 255.0;
      green = std::max<int>(green, image.rgba[i + 1]);
    }
    EXPECT_NEAR(opacity * height * height / (32 * 32), 3.0 / 8.0, 0.02) << height;
    EXPECT_EQ(green, 0) << height;
  }
}

TEST(SurfaceMaterials, ACutoffOfNothingLeavesNoHoles) {
  Square square({kOn, kOn, kOn, 0, kOn, kOn, kOn, 0, kOn, kOn, kOn, 0, kOn, kOn, kOn, kOn});
  square.appearance.materials[0].alpha = AlphaMode::Mask;
  square.appearance.materials[0].alpha_cutoff = 0.0;
  EXPECT_THAT(pixel_of(picture(square, small()), 8, 8), ElementsAre(kOn, kOn, kOn, kOn));
}

TEST(SurfaceMaterials, GlassMixesLightWithWhatIsBehind) {
  Square square(std::vector<std::uint8_t>(16, kOn));
  square.appearance.materials[0].alpha = AlphaMode::Blend;
  square.appearance.materials[0].opacity = 0.25;
  square.appearance.materials[0].colour = {1.0, 0.0, 0.0};
  EXPECT_EQ(picture(square, small()).pixel(16, 16)[3], std::lround(0.25 * 255));
  const Image before_black = picture(square, small(Rgb8{0, 0, 0}));
  EXPECT_EQ(before_black.pixel(16, 16)[0], srgb_of_linear(0.25));
  // Two panes let 3/4 of 3/4 through.
  square.mesh = test::together(square.mesh, square.mesh, Vec3(0, 0, -1));
  square.appearance.material_of_triangle.resize(4, 0);
  square.appearance.uv_of_triangle.resize(4, {0, 1, 2});
  EXPECT_EQ(picture(square, small()).pixel(16, 16)[3], std::lround((1.0 - 0.75 * 0.75) * 255));
}

TEST(SurfaceMaterials, EmissionIsAddedToWhatIsReflected) {
  // A black screen of which the left half is lit.
  Square square({kOn, kOn, kOn, kOn, 0, 0, 0, kOn, kOn, kOn, kOn, kOn, 0, 0, 0, kOn});
  Material& material = square.appearance.materials[0];
  material = {.emission = {0.2, 0.0, 0.1}, .emission_texture = 0};
  const auto reds = [&] {
    const Image image = picture(square, small());
    return std::array{linear_of_srgb(image.pixel(8, 16)[0]),
                      linear_of_srgb(image.pixel(24, 16)[0])};
  };
  const auto [white_lit, white] = reds();
  material.colour = {0.0, 0.0, 0.0};
  const auto [black_lit, black] = reds();
  EXPECT_NEAR(black_lit - black, 0.2, 0.02);  // bright light is compressed
  const std::vector<std::uint8_t> violet = pixel_of(picture(square, small()), 8, 16);
  EXPECT_GT(violet[0], violet[2]);
  EXPECT_GT(violet[2], violet[1]);
  EXPECT_GT(white_lit, white);
  EXPECT_NEAR(black, 0.03, 0.005);  // as charcoal is
  RenderOptions drawing = small();
  drawing.style = Style::Technical;
  EXPECT_EQ(picture(square, drawing).pixel(24, 16)[0], 0);  // its lines tell its shape
  material.unlit = true;
  EXPECT_EQ(reds()[1], 0.0);
}

TEST(SurfaceMaterials, EmissionEndsAsSmoothlyAsColoursDo) {
  Square square({kOn, kOn, kOn, kOn, 0, 0, 0, kOn, kOn, kOn, kOn, kOn, 0, 0, 0, kOn});
  square.appearance.materials[0] = {
      .colour = {0.0, 0.0, 0.0}, .emission = {0.5, 0.0, 0.0}, .emission_texture = 0};
  RenderOptions options = small();
  options.width = 31;  // the border is in the middle of a pixel
  options.height = 31;
  options.samples = 16;
  const Image image = picture(square, options);
  EXPECT_GT(image.pixel(15, 15)[0], image.pixel(20, 15)[0] + 20);
  EXPECT_LT(image.pixel(15, 15)[0], image.pixel(10, 15)[0] - 20);
}

TEST(SurfaceMaterials, EmissionIsNotShadedHoweverManySamplesAPixelTakes) {
  // An opaque wall takes one sample a pixel, glass several, even if next to nothing shines through.
  Square square(std::vector<std::uint8_t>(16, kOn));
  square.appearance.materials[0] = {.colour = {0.0, 0.0, 0.0}, .emission = {0.0, 0.5, 0.0}};
  const Image one = picture(square, small());
  square.appearance.materials[0].alpha = AlphaMode::Blend;
  square.appearance.materials[0].opacity = 0.999;
  const Image several = picture(square, small());
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(one.pixel(16, 16)[c], several.pixel(16, 16)[c], 1);
  }
  EXPECT_GT(one.pixel(16, 16)[1], srgb_of_linear(0.5) - 1);
}

TEST(SurfaceMaterials, AWallIsSeenThroughFortyPanesOfThinGlass) {
  Square square(std::vector<std::uint8_t>(16, kOn));
  square.appearance.materials[0].alpha = AlphaMode::Blend;
  square.appearance.materials[0].opacity = 0.02;
  const TriMesh pane = square.mesh;
  for (int k = 1; k <= 40; ++k) {
    square.mesh = test::together(square.mesh, pane, Vec3(0, 0, -0.01 * k));
  }
  const std::size_t faces = square.mesh.triangles.size();
  square.appearance.materials.push_back({.colour = {1.0, 0.0, 0.0}, .unlit = true});
  square.appearance.material_of_triangle.assign(faces, 0);
  square.appearance.material_of_triangle[faces - 2] = 1;  // the last pane is the wall
  square.appearance.material_of_triangle[faces - 1] = 1;
  square.appearance.uv_of_triangle.resize(faces, {0, 1, 2});
  EXPECT_EQ(picture(square, small()).pixel(16, 16)[3], 255);
}

TEST(SurfaceMaterials, FacesWithoutAMaterialAreOfTheOptionsColour) {
  Square square(std::vector<std::uint8_t>(16, kOn));
  square.appearance.material_of_triangle = {Appearance::kNone, Appearance::kNone};
  const Image with = picture(square, small());
  const Image without = render(square.mesh, before_square(), {}, {}, small());
  EXPECT_EQ(with.rgba, without.rgba);
}

TEST(SurfaceMaterials, VertexColoursMultiplyTheMaterial) {
  Square square(std::vector<std::uint8_t>(16, kOn));
  const std::vector<Rgb8> colours(4, Rgb8{0, 255, 0});
  square.appearance.materials[0].colour = {1.0, 0.5, 1.0};
  const Image image =
      render_painted(square.mesh, before_square(), {colours, {}, &square.appearance}, small());
  EXPECT_THAT(pixel_of(image, 16, 16), ElementsAre(0, srgb_of_linear(0.5), 0, kOn));
}

TEST(SurfaceMaterials, FacesWithoutCoordinatesShowTheMeanOfTheTexture) {
  Square square({kOn, 0, 0, kOn, kOn, 0, 0, kOn, 0, 0, 0, kOn, 0, 0, 0, kOn});
  square.appearance.uv_of_triangle.clear();
  EXPECT_NEAR(picture(square, small()).pixel(4, 28)[0], srgb_of_linear(0.5), 1);
}

TEST(SurfaceMaterials, RefusesMaterialsOfAnotherMesh) {
  Square square(std::vector<std::uint8_t>(16, kOn));
  square.appearance.material_of_triangle = {0, 7};
  EXPECT_THROW(picture(square, small()), InvalidInput);
  square.appearance.material_of_triangle = {0};
  EXPECT_THROW(picture(square, small()), InvalidInput);
}

TEST(DeepPicture, IsTheSamePictureWithFinerSteps) {
  const TriMesh mesh = test::torus(1.0, 0.4, 48, 24);
  Camera camera;
  camera.eye = {0, 2, 6};
  const RenderOptions options{.width = 48, .height = 40, .samples = 4, .ambient_rays = 2};
  const Image image = render(mesh, camera, {}, {}, options);
  const DeepImage deep = render_deep(mesh, camera, {}, options);
  ASSERT_EQ(deep.rgba.size(), image.rgba.size());
  int between = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    EXPECT_LE(std::abs(deep.rgba[i] / 257.0 - image.rgba[i]), 0.51);
    between += deep.rgba[i] % 257 != 0 ? 1 : 0;
  }
  EXPECT_GT(between, 1000);
  EXPECT_EQ(render_deep(mesh, camera, {}, options, {.max_threads = 1}).rgba, deep.rgba);
}

/// Mean light of a level, seen at the middles of its texels.
double mean_light(const TexturePyramid& pyramid, int size, float level) {
  double sum = 0.0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const auto at = [&](int i) {
        return (static_cast<float>(i) + 0.5F) / static_cast<float>(size);
      };
      sum += static_cast<double>(pyramid.at(at(x), at(y), level).colour.x());
    }
  }
  return sum / (size * size);
}

TEST(TexturePyramid, EveryLevelHasTheSameMeanLight) {
  Texture texture{Image{16, 16, {}}, TextureWrap::Repeat, TextureWrap::Repeat, false};
  for (int i = 0; i < 256; ++i) {
    const auto grey = static_cast<std::uint8_t>((i * 73) % 256);
    texture.image.rgba.insert(texture.image.rgba.end(), {grey, grey, grey, 255});
  }
  const TexturePyramid pyramid(texture);
  const double whole = mean_light(pyramid, 16, 0.0F);
  for (int level = 1; level <= 4; ++level) {
    // 16 bit a level: half a step of rounding each.
    EXPECT_NEAR(mean_light(pyramid, 16 >> level, static_cast<float>(level)), whole,
                level / 65535.0);
  }
}

TEST(TexturePyramid, RepeatsMirrorsAndClamps) {
  const Image stripe{2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};
  const auto seen = [&](TextureWrap wrap, float u) {
    const Texture texture{stripe, wrap, wrap, true};
    return TexturePyramid(texture).at(u, 0.5F, 0.0F).colour.x();
  };
  // Middles of the texels beyond the right border.
  EXPECT_EQ(seen(TextureWrap::Repeat, 1.25F), 0.0F);
  EXPECT_EQ(seen(TextureWrap::Mirror, 1.25F), 1.0F);
  EXPECT_EQ(seen(TextureWrap::Clamp, 1.75F), 1.0F);
  EXPECT_EQ(seen(TextureWrap::Repeat, -0.25F), 1.0F);
  EXPECT_EQ(seen(TextureWrap::Mirror, -0.25F), 0.0F);
  EXPECT_EQ(seen(TextureWrap::Clamp, -0.25F), 0.0F);
}

TEST(TexturePyramid, WhatCannotBeSeenGivesNoColour) {
  const Texture texture{Image{2, 1, {255, 0, 0, 255, 0, 255, 0, 0}}, TextureWrap::Clamp,
                        TextureWrap::Clamp, false};
  const Texel mean = TexturePyramid(texture).at(0.5F, 0.5F, 1.0F);
  EXPECT_EQ(mean.colour.y(), 0.0F);
  EXPECT_NEAR(mean.opacity, 0.5F, 1e-4F);
}

}  // namespace
}  // namespace vantage
