// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/core/image.h"
#include "vantage/mesh/topology.h"
#include "vantage/report/comparison.h"

namespace vantage {

/// The paper's figure 6: around the model the wireframe of all views of the set, farther out and
/// warmer the better the view from there is by a method. From a corner in front and always as near, so
/// that pictures of methods can be compared.
class ViewSpherePictures {
 public:
  /// Draws the model. \param comparison must outlive this. \param width px. \param height px.
  /// \throw Cancelled
  ViewSpherePictures(const ShapeAnalysis& shape, const Comparison& comparison, UpAxis up, int width,
                     int height, const RunContext& run);

  /// By a method of the comparison.
  [[nodiscard]] Image of(const ComparedMethod& method) const;

 private:
  const Comparison* comparison_;
  EdgeTable wires_;                                                            // of the set
  Vec3 right_ = Vec3::UnitX(), up_ = Vec3::UnitY(), towards_ = Vec3::UnitZ();  // the picture's axes
  double radius_px_ = 1.0;  // of the enclosing sphere
  Image model_{};           // without background
};

}  // namespace vantage
