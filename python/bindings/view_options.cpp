// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include "option_makers.h"

namespace vantage::python {
namespace {

constexpr int kLargestSide = 16384;  // as the program's --size

void add_camera_options(std::vector<Option>& table) {
  const std::string group = "camera";
  table.push_back(word_option(
      "projection", group, "of the scoring camera", {"perspective", "orthographic"},
      [](Settings& s, std::size_t i) { s.view.projection = static_cast<Projection>(i); },
      [](const Settings& s) { return s.view.projection; }));
  Option distance = number_option(
      "distance", group,
      "eye to centre, in radii of the enclosing sphere; unset: the sphere fills the view", 1.001,
      1e6, [](Settings& s) -> double& { return s.view.distance_factor.emplace(); });
  distance.value = [](const Settings& s) {
    return s.view.distance_factor ? py::cast(*s.view.distance_factor) : py::object(py::none());
  };
  table.push_back(std::move(distance));
  add_fields(
      table, group, kViewFields, [](Settings & s) -> auto& { return s.view; });
  table.push_back(word_option(
      "up", group,
      "up axis of the model; auto: z for STL, y otherwise, unless the model clearly stands on the "
      "other",
      {"auto", "x", "y", "z", "-x", "-y", "-z"},
      [](Settings& s, std::size_t i) {
        s.view.up = i == 0 ? std::nullopt : std::optional(static_cast<UpAxis>(i - 1));
      },
      [](const Settings& s) { return s.view.up ? 1 + static_cast<int>(*s.view.up) : 0; }));
}

/// The bytes of a prior's file.
std::string bytes_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw IoError(path, "cannot be opened", ENOENT);
  }
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void set_search(Settings& s, std::size_t choice) {
  constexpr std::array kStrategies{SearchStrategy::Rapid, SearchStrategy::Exhaustive,
                                   SearchStrategy::Global, SearchStrategy::Dense};
  SearchOptions& search = s.view.search;
  search.strategy = kStrategies.at(choice);
  const bool rapid = search.strategy == SearchStrategy::Rapid;
  search.base = rapid ? ViewSphereBase::Cube : ViewSphereBase::Icosahedron;
  search.subdivisions = rapid ? 0 : SearchOptions{}.subdivisions;
}

/// ε as a number (a raw sum) or as "0.1%" (of the total).
void set_epsilon(Settings& s, const py::object& given) {
  SearchOptions& search = s.view.search;
  search.epsilon_is_fraction = false;
  py::object number = given;
  if (py::isinstance<py::str>(given)) {
    auto text = given.cast<std::string>();
    search.epsilon_is_fraction = !text.empty() && text.back() == '%';
    if (search.epsilon_is_fraction) {
      text.pop_back();
    }
    number = py::str(text);
  }
  try {
    search.epsilon = py::float_(number).cast<double>();
  } catch (const py::error_already_set&) {
    throw InvalidInput("option epsilon must be a number, or a string of a number and %");
  }
  if (!(search.epsilon >= 0.0) || !std::isfinite(search.epsilon)) {
    throw InvalidInput("option epsilon must not be negative");
  }
  if (search.epsilon_is_fraction) {
    search.epsilon /= 100.0;
  }
}

Option search_option() {
  return word_option(
      "search", "search",
      "global: finds what dense finds, by a fraction of its scores; dense: 10242 directions, then "
      "refinement, slow; rapid: the paper's; exhaustive: a direction set; gradient: Lee's ascent "
      "from random starts",
      {"rapid", "exhaustive", "global", "dense", "gradient"}, set_search,
      [](const Settings& s) { return s.view.search.strategy; });
}

Option prior_option() {
  return {.name = "prior",
          .group = "search",
          .type = "str",
          .help =
              "what the best view's score is multiplied by: none, upright (how people look at "
              "things), or the path of a JSON file",
          .set =
              [](Settings& s, const py::object& given) {
                const auto name =
                    py::module_::import("os").attr("fspath")(given).cast<std::string>();
                s.view.prior = name == "none"      ? no_prior()
                               : name == "upright" ? upright_prior()
                                                   : parse_prior(bytes_of_file(name), name);
              },
          .value = [](const Settings& s) { return py::cast(s.view.prior.name); }};
}

Option epsilon_option() {
  return {.name = "epsilon",
          .group = "search",
          .type = "float | str",
          .help =
              "rapid search stops when a ring gains less: a raw sum, or a share of the total "
              "as \"0.1%\"",
          .set = set_epsilon,
          .value = [](const Settings& s) {
            const SearchOptions& search = s.view.search;
            if (!search.epsilon_is_fraction) {
              return py::object(py::float_(search.epsilon));
            }
            return py::object(py::str(py::float_(100.0 * search.epsilon)) + py::str("%"));
          }};
}

Option seed_option() {
  return {.name = "seed",
          .group = "search",
          .type = "int",
          .help = "start of random sequences: search=\"gradient\" draws its starts, from 0 up",
          .set =
              [](Settings& s, const py::object& given) {
                if (!py::isinstance<py::int_>(given) || given < py::int_(0)) {
                  throw InvalidInput("option seed must be a whole number from 0 up");
                }
                s.view.search.seed = given.cast<std::uint64_t>();
              },
          .value = [](const Settings& s) { return py::cast(s.view.search.seed); }};
}

void add_search_options(std::vector<Option>& table) {
  const std::string group = "search";
  table.push_back(word_option(
      "base", group, "polyhedron of the view sphere; cube for search=\"rapid\"",
      {"cube", "icosahedron"},
      [](Settings& s, std::size_t i) { s.view.search.base = static_cast<ViewSphereBase>(i); },
      [](const Settings& s) { return s.view.search.base; }));
  add_fields(
      table, group, kSearchFields, [](Settings & s) -> auto& { return s.view.search; });
  add_fields(
      table, group, kGradientFields, [](Settings & s) -> auto& { return s.view.search; });
  table.push_back(seed_option());
  table.push_back(epsilon_option());
  table.push_back(switch_option(
      "certify", group, "search densely as well, and tell how far the views found are behind; slow",
      [](Settings & s) -> auto& { return s.view.certify; }));
}

ViewSetRequest& set_of(Settings& s) {
  return s.view.view_set ? *s.view.view_set : s.view.view_set.emplace();
}

/// A number of which there may be none.
template <class Value>
Option optional_number(Option option, std::optional<Value> Settings::*member) {
  option.value = [member](const Settings& s) {
    return s.*member ? py::cast(*(s.*member)) : py::object(py::none());
  };
  return option;
}

void add_set_options(std::vector<Option>& table) {
  const std::string group = "set";
  table.push_back(
      optional_number(number_option("views", group, "also this many views that together see most",
                                    1, 1000, [](Settings& s) -> int& { return s.views.emplace(); }),
                      &Settings::views));
  table.push_back(optional_number(
      number_option("coverage", group,
                    "also views until this share of what can be seen at all is seen, above 0", 0.0,
                    1.0, [](Settings& s) -> double& { return s.coverage.emplace(); }),
      &Settings::coverage));
  table.push_back(number_option(
      "min_separation", group, "least angle between two of the views, degrees", 0.0, 180.0,
      [](Settings& s) -> double& { return set_of(s).set.min_separation_deg; }));
  table.push_back(word_option(
      "select", group,
      "kssm: newly seen significance; vazquez: entropy of unseen faces; feixas: merging by mutual "
      "information",
      {"kssm", "vazquez", "feixas"},
      [](Settings& s, std::size_t i) { set_of(s).selection = static_cast<ViewSelection>(i); },
      [](const Settings& s) {
        return s.view.view_set ? s.view.view_set->selection : ViewSelection::Kssm;
      }));
  add_fields(table, group, kViewSetRequestFields, set_of);
  table.push_back(switch_option(
      "refine", group, "move views away from the 2562 candidate directions",
      [](Settings & s) -> auto& { return set_of(s).set.refine; }));
}

/// "800x600", "256", 256 or (800, 600).
void set_size(Settings& s, const py::object& given) {
  py::object sides = given;
  if (py::isinstance<py::str>(given)) {
    sides = given.attr("split")("x");
  } else if (!py::isinstance<py::sequence>(given)) {
    sides = py::make_tuple(given);
  }
  const py::sequence pair = sides;
  try {
    if (pair.size() != 1 && pair.size() != 2) {
      throw py::cast_error();
    }
    s.view.width = py::int_(py::object(pair[0])).cast<int>();
    s.view.height = py::int_(py::object(pair[pair.size() - 1])).cast<int>();
  } catch (const std::exception&) {
    throw InvalidInput("option size must be (width, height), one number, or \"WIDTHxHEIGHT\"");
  }
  if (s.view.width < 1 || s.view.height < 1 || s.view.width > kLargestSide ||
      s.view.height > kLargestSide) {
    throw InvalidInput("option size: sides must be between 1 and 16384 pixels");
  }
}

Option size_option() {
  return {.name = "size",
          .group = "size",
          .type = "tuple[int, int] | int | str",
          .help = "of pictures in pixels: (width, height), one number for a square, or \"800x600\"",
          .set = set_size,
          .value = [](const Settings& s) {
            return py::object(py::make_tuple(s.view.width, s.view.height));
          }};
}

}  // namespace

void finish_view_set(Settings& settings) {
  const bool by_information = settings.view.view_set && settings.view.view_set->information > 0.0;
  if (!settings.views && !settings.coverage && !by_information) {
    const bool asks_for_some =
        settings.view.view_set && (settings.view.view_set->selection != ViewSelection::Kssm ||
                                   settings.view.view_set->set.min_separation_deg > 0.0);
    if (asks_for_some) {
      throw InvalidInput("say how many views are wanted, with views or coverage");
    }
    settings.view.view_set.reset();
    return;
  }
  ViewSetRequest& request = set_of(settings);
  if (settings.coverage && !(*settings.coverage > 0.0)) {
    throw InvalidInput("option coverage must be above 0");
  }
  if (by_information && request.selection != ViewSelection::Feixas) {
    throw InvalidInput("option information needs select=\"feixas\"");
  }
  if (request.selection != ViewSelection::Kssm &&
      (settings.coverage || request.set.min_separation_deg > 0.0)) {
    throw InvalidInput("select=\"" + std::string(selection_name(request.selection)) +
                       "\" chooses a number of views; coverage and min_separation go with "
                       "select=\"kssm\"");
  }
  request.set.views = settings.views.value_or(0);
  request.set.coverage = settings.coverage.value_or(1.0);
}

void add_view_options(std::vector<Option>& table) {
  // The search says where it starts before single numbers of it are changed.
  table.push_back(search_option());
  table.push_back(prior_option());
  add_search_options(table);
  add_camera_options(table);
  add_set_options(table);
  table.push_back(size_option());
}

}  // namespace vantage::python
