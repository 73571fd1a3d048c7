// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "vantage/pipeline/find_views.h"

#include "support/model_of.h"
#include "support/same_picture.h"
#include "support/shapes.h"

namespace vantage::test {
namespace {

TEST(FindPictureView, OfALargeSurfaceLooksAtADecimatedCopyAndFramesTheWhole) {
  const Model model = model_of(torus(1.0, 0.4, 640, 320));
  ASSERT_GT(model.mesh.positions.size(), 200'000U);
  const ShapeAnalysis prepared = prepare_surface(model);
  const PictureView found = find_picture_view(model, prepared, {});
  EXPECT_LE(found.vertices, 100'000U);
  EXPECT_GT(found.vertices, 90'000U);
  const ReportedView framed =
      describe_view(prepared, VertexVisibility(prepared.surface, prepared.sides),
                    scoring_camera(prepared, {}), found.view.direction, found.choice.frame.up, {});
  expect_same_picture(found.view, framed);
}

}  // namespace
}  // namespace vantage::test
