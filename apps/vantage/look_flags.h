// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "vantage/io/model.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

#include "option_flags.h"
#include "picture_file.h"

/// \file
/// Flags for how a picture looks, the same for every command that makes one.

namespace vantage::cli {

/// Turns flags into RenderOptions.
class LookFlags {
 public:
  /// Adds the flags of a command that makes one picture. \param quality what is used unless given.
  void add_to(CLI::App& app, Quality quality);

  /// Adds the flags of a command that makes several, all but --depth. \param style used unless given.
  void add_to_several(CLI::App& app, Style style = Style::Asset);

  /// A style to use unless a flag names another.
  void suggest(const std::optional<Style>& style) {
    start_.look.style = style.value_or(start_.look.style);
  }

  /// The look that was asked for; the size is left alone.
  [[nodiscard]] RenderOptions look() const { return resolved().look; }

  /// The same on the ground of a model whose up axis is known.
  [[nodiscard]] RenderOptions look(const Vec3& up) const;

  /// Whether the colours and materials of the file are wanted.
  [[nodiscard]] bool of_asset() const { return look().style == Style::Asset; }

  /// Refuses what a picture of this name cannot hold; before any work. \throw CLI::ValidationError
  void check(const std::string& path, const ViewOptions& options) const {
    check_depth(path, depth_);
    if (!options.fit_size) {  // else the view says what its sides are
      check_sides(path, options.width, options.height);
    }
  }

  /// What to read of the file for a picture of that size.
  [[nodiscard]] ReadOptions reading(int width, int height) const;

  /// Takes the picture that was asked for and writes it, in as many bits as were asked for.
  /// \return emptiness_warning().
  /// \throw IoError, InvalidInput, Cancelled
  std::string write(const std::string& path, const Model& model, const ShapeAnalysis& shape,
                    const Camera& camera, Picture picture, const ViewOptions& options,
                    const Vec3& up, const RunContext& run) const;

  /// Of all pictures of a model, on the ground if its up axis is known. \param model must outlive it.
  [[nodiscard]] PictureLook of(const Model& model, const Vec3& up = Vec3::UnitY()) const {
    return PictureLook(look(up), of_asset() ? &model : nullptr);
  }

  /// The options of pictures as words say them, for a hash.
  [[nodiscard]] std::string text() const;

  /// Empty border, per cent of the picture's shorter side.
  [[nodiscard]] double margin_percent() const { return resolved().view.margin_percent; }

 private:
  [[nodiscard]] AllOptions resolved() const;

  AllOptions start_{};  // unless flags say otherwise
  OptionFlags flags_{};
  int depth_ = 8;
};

}  // namespace vantage::cli
