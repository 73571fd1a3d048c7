// SPDX-License-Identifier: MIT
#include <algorithm>
#include <functional>
#include <initializer_list>
#include <variant>

#include "vantage/core/error.h"
#include "vantage/pipeline/option_table.h"

namespace vantage {
namespace {

using IsGiven = std::function<bool(std::string_view)>;

/// Refuses the first of the named options that was given.
void refuse_any(std::initializer_list<std::string_view> names, const IsGiven& is_given,
                const std::string& why) {
  for (const std::string_view name : names) {
    if (is_given(name)) {
      throw InvalidInput("option " + std::string(name) + " " + why);
    }
  }
}

void check_search(const ViewOptions& options, const IsGiven& is_given) {
  const SearchStrategy strategy = options.search.strategy;
  if (strategy != SearchStrategy::Gradient) {
    refuse_any({"starts"}, is_given, "goes with search gradient only");
  }
  if (strategy != SearchStrategy::Rapid) {
    refuse_any({"epsilon"}, is_given, "goes with search rapid only");
  }
  if (strategy != SearchStrategy::Rapid && strategy != SearchStrategy::Exhaustive) {
    refuse_any({"base", "subdivisions"}, is_given, "goes with search rapid and exhaustive only");
  }
}

void check_objective(const ViewOptions& options, const IsGiven& is_given) {
  if (!is_given("objective")) {
    return;
  }
  refuse_any({"prior"}, is_given, "says what is maximised, as objective does: give one");
  if (options.objective == Objective::People && objective_of(options) != Objective::People) {
    refuse_any({"objective"}, is_given,
               "people goes with search global, dense and exhaustive only");
  }
}

/// Names of the options of groups, but for the preset, which is of all groups, and `but`.
std::vector<std::string> names_in(std::initializer_list<std::string_view> groups,
                                  std::string_view but = {}) {
  std::vector<std::string> names;
  for (const Option& option : option_table()) {
    if (option.name != "preset" && option.name != but && option.is_listed() &&
        std::find(groups.begin(), groups.end(), option.group) != groups.end()) {
      names.push_back(option.name);
    }
  }
  return names;
}

template <class Uses>
bool uses_any(const std::vector<Measure>& measures, const Uses& uses) {
  return std::any_of(measures.begin(), measures.end(), uses);
}

bool uses_saliency(const std::vector<Measure>& measures) {
  return uses_any(measures, [](const Measure& m) { return m.needs.saliency; });
}

IdleOptions all_of_saliency() {
  return {names_in({"saliency"}), "goes with --method mesh-saliency only"};
}

}  // namespace

std::string flag_of(const Option& option) {
  const OptionValue value = option.value({});
  const bool* const is_on = std::get_if<bool>(&value);
  return (is_on != nullptr && *is_on ? "--no-" : "--") + option.name;
}

void check_together(const ViewOptions& options, const IsGiven& is_given) {
  check_search(options, is_given);
  check_objective(options, is_given);
  if (options.projection == Projection::Orthographic) {
    refuse_any({"fov", "distance"}, is_given, "goes with projection perspective only");
  }
  if (options.kssm_to_finished_graph || !options.skeleton.fit) {
    refuse_any({"level-agreement"}, is_given,
               "compares two fitted curves: leave out graph finished and no-fit");
  }
  if (options.up && options.up != UpAxis::Any && options.front &&
      up_vector(*options.up).dot(up_vector(*options.front)) != 0.0) {
    throw InvalidInput("option front is along the axis of up: give one at right angles to it");
  }
}

std::vector<IdleOptions> idle_in_picture(const PictureRequest& picture) {
  std::vector<IdleOptions> idle;
  if (picture.has_camera) {
    idle.push_back({{"projection", "distance", "fov", "margin", "front"},
                    "says what --camera says: leave one out"});
    if (!picture.has_ground) {
      idle.back().names.emplace_back("up");
    }
  }
  idle.push_back(
      {{"certify"}, "has no effect on a picture: view reports how far views are behind"});
  if (!picture.is_searched) {
    idle.push_back({names_in({"search"}), "goes with --view only: else nothing is searched"});
  }
  if (!picture.is_searched && !picture.shows_map) {
    // Pictures are framed on the focus.
    idle.push_back({names_in({"map", "method"}, "focus"),
                    "goes with --view, --show kssm and --show skeleton only: else no map is made"});
  }
  return idle;
}

std::vector<IdleOptions> idle_in_views(const std::vector<Measure>& measures) {
  std::vector<IdleOptions> idle;
  if (!uses_saliency(measures)) {
    idle.push_back(all_of_saliency());
  }
  return idle;
}

std::vector<IdleOptions> idle_in_scores(const std::vector<Measure>& measures, bool of_eyes) {
  const bool by_kssm = uses_any(measures, [](const Measure& m) { return m.needs.kssm; });
  const bool by_skeleton = uses_any(measures, [](const Measure& m) { return m.needs.skeleton; });
  std::vector<IdleOptions> idle = idle_in_views(measures);
  if (of_eyes) {
    idle.push_back({{"projection", "distance", "fov"},
                    "goes with --sphere and --directions: --eyes says where eyes are"});
  }
  if (!by_kssm) {  // sums of any map heed the weight
    idle.push_back({names_in({"map"}, "weight"), "goes with --method kssm only"});
  }
  if (!by_kssm && !uses_saliency(measures)) {
    idle.push_back({{"weight"}, "goes with --method kssm and mesh-saliency only"});
  }
  if (!by_kssm && !by_skeleton) {
    idle.push_back({names_in({"method"}), "goes with methods of the skeleton only, such as kssm"});
  }
  return idle;
}

std::vector<IdleOptions> idle_in_map(std::string_view map) {
  std::vector<IdleOptions> idle;
  if (map != "mesh-saliency") {
    idle.push_back(all_of_saliency());
  }
  if (map != "kssm" && map != "thickness") {
    idle.push_back({names_in({"map", "method"}), "goes with --method kssm and thickness only"});
  }
  if (map == "thickness") {
    idle.push_back({{"suppression", "weight"},
                    "goes with --method kssm only: thickness is the distance alone"});
  }
  if (map != "pmi-saliency") {
    idle.push_back({{"projection", "distance", "fov"},
                    "goes with --method pmi-saliency only: other maps ask for no camera"});
  }
  return idle;
}

}  // namespace vantage
