// SPDX-License-Identifier: MIT
#include "vantage/pipeline/option_table.h"

#include <algorithm>
#include <utility>

#include "vantage/core/error.h"

#include "core/json_text.h"
#include "pipeline/option_echo.h"
#include "pipeline/option_rows.h"

namespace vantage {
namespace {

using Json = OrderedJson;

/// Lets an option set what follows from it, too.
void also(std::vector<Option>& rows, std::string_view name,
          const std::function<void(AllOptions&)>& follow) {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const Option& o) { return o.name == name; });
  row->set = [set = row->set, follow](AllOptions& all, const OptionValue& value) {
    set(all, value);
    follow(all);
  };
}

/// A rapid search begins with the corners of a cube, as the paper's does.
void begin_search(AllOptions& all) {
  SearchOptions& search = all.view.search;
  const bool is_rapid = search.strategy == SearchStrategy::Rapid;
  search.base = is_rapid ? ViewSphereBase::Cube : ViewSphereBase::Icosahedron;
  search.subdivisions = is_rapid ? 0 : SearchOptions{}.subdivisions;
}

std::vector<Option> make_table() {
  OptionRows table;
  table.add(
      kViewFields, [](const AllOptions& all) -> const ViewOptions& { return all.view; },
      [](AllOptions& all) -> ViewOptions& { return all.view; });
  const std::size_t of_view = table.rows.size();
  const std::tuple look{Group{"look", "Pictures"}, Part{&AllOptions::look, kRenderFields}};
  table.add(
      look, [](const AllOptions& all) -> const AllOptions& { return all; },
      [](AllOptions& all) -> AllOptions& { return all; });
  for (std::size_t i = of_view; i < table.rows.size(); ++i) {
    table.rows[i].is_of_pictures = true;
  }
  also(table.rows, "preset", [](AllOptions& all) { all.view = preset_options(all.view.preset); });
  also(table.rows, "search", begin_search);
  return std::move(table.rows);
}

Json json_of(const OptionValue& value) {
  return std::visit(
      [](const auto& held) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(held)>, std::monostate>) {
          return Json(nullptr);
        } else {
          return Json(held);
        }
      },
      value);
}

}  // namespace

const std::vector<Option>& option_table() {
  static const std::vector<Option> kTable = make_table();
  return kTable;
}

const Option& find_option(std::string_view name) {
  for (const Option& option : option_table()) {
    if (option.name == name) {
      return option;
    }
  }
  throw InvalidInput("there is no option " + std::string(name));
}

AllOptions all_options(Preset preset, Quality quality) {
  AllOptions all{.view = preset_options(preset)};
  set_quality(all.look, quality);
  return all;
}

std::optional<ViewSetRequest> checked_view_set(const ViewOptions& options) {
  if (!options.view_set) {
    return std::nullopt;
  }
  const ViewSetRequest& request = *options.view_set;
  const bool by_kssm = request.selection == ViewSelection::Kssm;
  if (request.set.coverage && !(*request.set.coverage > 0.0)) {
    throw InvalidInput("option coverage must be above 0");
  }
  if (request.information > 0.0 && request.selection != ViewSelection::Feixas) {
    throw InvalidInput("option information goes with select feixas only");
  }
  const std::string select = "option select is " + std::string(selection_name(request.selection));
  if (request.selection == ViewSelection::Feixas && request.set.coverage) {
    throw InvalidInput(select +
                       ", which ends by views or information; coverage goes with select "
                       "kssm and vazquez");
  }
  if (!by_kssm && request.set.min_separation_deg > 0.0) {
    throw InvalidInput(select + "; min-separation goes with select kssm");
  }
  if (!by_kssm && !request.set.refine) {
    throw InvalidInput(select + ", which refines nothing; no-refine goes with select kssm");
  }
  if (request.set.views || request.set.coverage || request.information > 0.0) {
    return request;
  }
  if (!by_kssm || request.set.min_separation_deg > 0.0 || request.path == TourPath::Explore ||
      !request.set.refine) {
    throw InvalidInput(
        "option views is not given: say how many views are wanted, by views or coverage");
  }
  return std::nullopt;
}

OrderedJson option_echo(const ViewOptions& options) {
  const AllOptions all{.view = options};
  Json json;
  for (const Option& option : option_table()) {
    if (!option.is_of_pictures) {
      json[option.name] = json_of(option.value(all));
    }
  }
  return json;
}

std::string options_json(const AllOptions& options) {
  Json json = option_echo(options.view);
  for (const Option& option : option_table()) {
    if (option.is_of_pictures) {
      json[option.name] = json_of(option.value(options));
    }
  }
  return json_text(json);
}

}  // namespace vantage
