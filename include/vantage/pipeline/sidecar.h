// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vantage/core/vec3.h"
#include "vantage/pipeline/view_options.h"
#include "vantage/render/render.h"

/// \file
/// A small file beside a model that says once how it stands and how it is to be shown.

namespace vantage {

/// What a sidecar says. What it leaves out is not set.
struct Sidecar {
  std::string file{};             ///< Its name; empty: there is none.
  std::optional<UpAxis> up{};     ///< "up": "z".
  std::optional<UpAxis> front{};  ///< "front": "-y".
  std::optional<Vec3> view{};     ///< "view": [x, y, z], unit, from the centre to the eye.
  std::optional<Style> style{};   ///< "style": "clay", "asset" or "technical".

  /// Sets up, front and the best view of `options` where they are not set: flags come first.
  void apply(ViewOptions& options) const;
};

/// Reads a sidecar: a JSON object with some of the members up, front, view, style and no other.
/// \throw FormatError naming the member; also for more than 64 KiB.
Sidecar parse_sidecar(std::string_view bytes, std::string_view name);

/// The sidecar of a model: MODEL.vantage.json (MODEL with or without its extension), else
/// vantage.json in its folder, else an empty one. \param model path of the model; "-" has none.
/// \throw IoError, FormatError
Sidecar sidecar_of(const std::string& model);

}  // namespace vantage
