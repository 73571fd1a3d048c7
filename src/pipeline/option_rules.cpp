// SPDX-License-Identifier: MIT
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

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

}  // namespace

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

}  // namespace vantage
