// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vantage/core/error.h"
#include "vantage/render/render.h"

namespace vantage {
namespace {

using testing::Optional;

TEST(Background, IsSetByItsWords) {
  RenderOptions look;
  set_background(look, "white:#102030");
  EXPECT_THAT(look.background, Optional(Rgb8{255, 255, 255}));
  EXPECT_THAT(look.background_bottom, Optional(Rgb8{16, 32, 48}));
  set_background(look, "#FFfe00");
  EXPECT_THAT(look.background, Optional(Rgb8{255, 254, 0}));
  EXPECT_FALSE(look.background_bottom.has_value());
  set_background(look, "gradient");
  EXPECT_TRUE(look.background && look.background_bottom);
  set_background(look, "transparent");
  EXPECT_FALSE(look.background || look.background_bottom);
}

class RefusedBackground : public testing::TestWithParam<const char*> {};

TEST_P(RefusedBackground, ChangesNothing) {
  RenderOptions look;
  set_background(look, "black:white");
  EXPECT_THROW(set_background(look, GetParam()), InvalidInput);
  EXPECT_THAT(look.background, Optional(Rgb8{0, 0, 0}));
  EXPECT_THAT(look.background_bottom, Optional(Rgb8{255, 255, 255}));
}

INSTANTIATE_TEST_SUITE_P(Words, RefusedBackground,
                         testing::Values("", "mauve", "white:", ":white", "#12345", "#1234567",
                                         "#12345g", "#-1-1-1", "white:black:white",
                                         "transparent:white"));

}  // namespace
}  // namespace vantage
