// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "vantage/render/render.h"

/// \file
/// Flags for how a picture looks, the same for every command that makes one.

namespace vantage::cli {

/// Turns flags into RenderOptions.
class LookFlags {
 public:
  /// Adds the flags. \param quality what is used unless given.
  void add_to(CLI::App& app, Quality quality);

  /// The look that was asked for; the size is left alone.
  [[nodiscard]] const RenderOptions& look() const { return look_; }

  /// The same on the ground of a model whose up axis is known.
  [[nodiscard]] RenderOptions look(const Vec3& up) const;

  /// Whether the colours of the file are wanted.
  [[nodiscard]] bool of_asset() const { return asset_; }

  /// Empty border as a fraction of the picture's shorter side.
  [[nodiscard]] double margin() const { return margin_per_cent_ / 100.0; }

 private:
  RenderOptions look_{};
  bool asset_ = false;
  double margin_per_cent_ = 4.0;
};

}  // namespace vantage::cli
