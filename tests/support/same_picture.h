// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "vantage/pipeline/find_views.h"

namespace vantage::test {

/// That two views have the same picture's camera and size, to the bit.
inline void expect_same_picture(const ReportedView& view, const ReportedView& expected) {
  EXPECT_EQ(view.picture.projection, expected.picture.projection);
  EXPECT_EQ(view.picture.eye, expected.picture.eye);
  EXPECT_EQ(view.picture.target, expected.picture.target);
  EXPECT_EQ(view.picture.up, expected.picture.up);
  EXPECT_EQ(view.picture.fov_y_deg, expected.picture.fov_y_deg);
  EXPECT_EQ(view.picture.height, expected.picture.height);
  EXPECT_EQ(view.size.width, expected.size.width);
  EXPECT_EQ(view.size.height, expected.size.height);
}

}  // namespace vantage::test
