// SPDX-License-Identifier: MIT
#include <string>

#include "vantage/pipeline/find_views.h"

#include "pipeline/view_preparation.h"
#include "view/stance.h"

namespace vantage {

UpChoice choose_up(const Model& model, const ShapeAnalysis& shape, const ViewOptions& options) {
  if (options.up.has_value()) {
    return {*options.up, "given", {}};
  }
  const UpAxis expected = default_up(model.format);
  if (model.format == ModelFormat::Gltf || model.format == ModelFormat::Glb) {
    return {expected, "format", {}};
  }
  const UpAxis other = expected == UpAxis::Y ? UpAxis::Z : UpAxis::Y;
  const Posture posture = posture_of(shape);
  const bool is_y = expected == UpAxis::Y;
  if (!stands_only_on(is_y ? posture.with_z_up : posture.with_y_up,
                      is_y ? posture.with_y_up : posture.with_z_up)) {
    return {expected, "format", {}};
  }
  const std::string name(up_name(other));
  return {other, "stance",
          "up is taken to be " + name +
              " because the model stands on a broad base that way and has none with " +
              std::string(up_name(expected)) + " up, the usual axis of its format; --up " +
              std::string(up_name(expected)) + " overrules this"};
}

}  // namespace vantage
