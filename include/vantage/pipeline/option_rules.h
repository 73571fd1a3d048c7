// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vantage/pipeline/option_table.h"
#include "vantage/view/measure.h"

/// \file
/// Rules of options beside their table: how a flag is written, and what changes nothing in what is
/// asked for. The program refuses such flags, Python such keywords.

namespace vantage {

/// Its flag: "--NAME", or "--no-NAME" of a switch that is on.
std::string flag_of(const Option& option);

/// Options without effect.
struct IdleOptions {
  std::vector<std::string> names{};  ///< As in option_table().
  std::string why{};                 ///< What follows a name, such as "goes with --view only".
};

/// What a picture is asked to be.
struct PictureRequest {
  bool has_camera = false;   ///< Its camera is given.
  bool is_searched = false;  ///< Of the best view, or the worst.
  bool shows_map = false;    ///< Or a skeleton.
  bool has_ground = false;   ///< So that it matters what is up.
};

/// Options without effect on a picture.
std::vector<IdleOptions> idle_in_picture(const PictureRequest& picture);

/// Options without effect on a search by these measures, or where they are compared.
std::vector<IdleOptions> idle_in_views(const std::vector<Measure>& measures);

/// Options without effect on scores. \param of_eyes whether eyes are given instead of directions.
std::vector<IdleOptions> idle_in_scores(const std::vector<Measure>& measures, bool of_eyes);

/// Options without effect on one number a vertex. \param map "kssm", "thickness", "mesh-saliency" or
/// "pmi-saliency".
std::vector<IdleOptions> idle_in_map(std::string_view map);

}  // namespace vantage
