// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/core/fields.h"
#include "vantage/pipeline/view_options.h"
#include "vantage/render/render.h"
#include "vantage/view/measure.h"

/// \file
/// Every option of the method and of its pictures as one list, made from the tables beside the
/// options structs. The program's flags, its help, completions and settings, Python's keywords, the
/// options in view.json and their hash are this list, walked. Beside it the rules of which have no
/// effect on what is asked for: the program refuses such flags, Python such keywords.

namespace vantage {

/// All that may be asked for.
struct AllOptions {
  ViewOptions view{};    ///< What shapes a view.
  RenderOptions look{};  ///< What its pictures look like.
};

/// What an option is given as; nothing where an optional one is unset. Choices are their words.
using OptionValue = std::variant<std::monostate, bool, std::uint64_t, double, std::string>;

/// What values of an option are.
enum class OptionKind {
  Number,   ///< double
  Integer,  ///< std::uint64_t
  Switch,   ///< bool
  Choice,   ///< std::string, one of its words
  Text,     ///< std::string
};

/// One option.
struct Option {
  std::string name{};                  ///< As flags and results have it, e.g. "max-steps".
  std::string group{};                 ///< Which commands and functions offer it, e.g. "camera".
  std::string heading{};               ///< That the help lists it under.
  std::string help{};                  ///< One line; empty: neither a flag nor a keyword.
  std::string off_help{};              ///< Of a switch that is on unless `--no-NAME` is given.
  OptionKind kind = OptionKind::Text;  ///< What its values are.
  TextForm form = TextForm::Plain;     ///< Of a text.
  std::vector<std::string> words{};    ///< Of a choice.
  double low = 0.0;                    ///< Of a number.
  double high = 0.0;                   ///< Of a number.
  bool is_of_pictures = false;         ///< Of RenderOptions: no part of view.json.
  std::function<OptionValue(const AllOptions&)> value{};  ///< What it is.
  /// Sets it, and what follows from it. \throw InvalidInput that begins with "option NAME"
  std::function<void(AllOptions&, const OptionValue&)> set{};

  [[nodiscard]] bool is_listed() const { return !help.empty(); }  ///< Has a flag and a keyword.
};

/// All options in the order in which they are to be set.
const std::vector<Option>& option_table();

/// The option of that name. \throw InvalidInput if there is none.
const Option& find_option(std::string_view name);

/// What a preset stands for. \param quality of pictures.
AllOptions all_options(Preset preset, Quality quality = Quality::Normal);

/// The request that view_set of `options` holds, if it says how many views are wanted; nothing if it
/// asks for none. \throw InvalidInput if it asks for some and does not say how many, or by what does
/// not go together.
std::optional<ViewSetRequest> checked_view_set(const ViewOptions& options);

/// Refuses what was given and contradicts other options, or has no effect beside them. \param is_given
/// tells by an option's name. \throw InvalidInput that begins with "option NAME"
void check_together(const ViewOptions& options,
                    const std::function<bool(std::string_view)>& is_given);

/// {"NAME": VALUE, …}: all options, as they are.
std::string options_json(const AllOptions& options);

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
