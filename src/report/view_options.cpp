// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "vantage/core/version.h"
#include "vantage/report/view_report.h"

#include "report/option_echo.h"

namespace vantage {
namespace {

template <class Options, class Table>
void echo_fields(nlohmann::ordered_json& json, const Options& options, const Table& table) {
  for_each_field(
      table, [&](const auto& field) { json[std::string(field.name)] = options.*(field.member); });
}

/// Everything of a prior that shapes the result; its name does not.
nlohmann::ordered_json prior_echo(const ViewPrior& prior) {
  nlohmann::ordered_json json;
  if (prior.is_uniform) {
    return json;
  }
  echo_fields(json, prior.upright, kUprightPriorFields);
  for (const PriorLobe& lobe : prior.lobes) {
    json["lobes"].push_back(
        {lobe.direction.x(), lobe.direction.y(), lobe.direction.z(), lobe.weight, lobe.width_rad});
  }
  return json;
}

}  // namespace

Vec3 up_vector(UpAxis axis) {
  switch (axis) {
    case UpAxis::X:
      return Vec3::UnitX();
    case UpAxis::Y:
      return Vec3::UnitY();
    case UpAxis::Z:
      return Vec3::UnitZ();
    case UpAxis::MinusX:
      return -Vec3::UnitX();
    case UpAxis::MinusY:
      return -Vec3::UnitY();
    case UpAxis::MinusZ:
      return -Vec3::UnitZ();
  }
  return Vec3::UnitY();
}

std::string_view up_name(UpAxis axis) {
  constexpr std::array<std::string_view, 6> kNames{"x", "y", "z", "-x", "-y", "-z"};
  return kNames[static_cast<std::size_t>(axis)];
}

UpAxis default_up(ModelFormat format) {
  // A printer's plate lies in x and y.
  return format == ModelFormat::Stl || format == ModelFormat::Threemf ? UpAxis::Z : UpAxis::Y;
}

std::string_view strategy_name(SearchStrategy strategy) {
  constexpr std::array<std::string_view, 5> kNames{"rapid", "exhaustive", "global", "dense",
                                                   "gradient"};
  return kNames[static_cast<std::size_t>(strategy)];
}

std::string_view base_name(ViewSphereBase base) {
  return base == ViewSphereBase::Cube ? "cube" : "icosahedron";
}

std::string_view weight_name(Weight weight) {
  return weight == Weight::Area ? "area" : "vertex";
}

std::string_view preset_name(Preset preset) {
  return preset == Preset::Paper ? "paper" : "default";
}

std::string_view projection_name(Projection projection) {
  return projection == Projection::Perspective ? "perspective" : "orthographic";
}

ViewOptions preset_options(Preset preset) {
  ViewOptions options;
  options.preset = preset;
  if (preset == Preset::Paper) {
    options.contraction.method = ContractionMethod::Exact;
    options.contraction.scaling = ContractionScaling::Box;
    options.contraction.sheet_limit = 1.0;  // never above the other: nothing is thinned
    options.skeleton.scaling = ContractionScaling::Box;
    options.prior = no_prior();
    options.kssm.flat_level = 0.0;
    options.search = {.strategy = SearchStrategy::Rapid,
                      .base = ViewSphereBase::Cube,
                      .subdivisions = 0,
                      .epsilon = 0.1,
                      .epsilon_is_fraction = false,
                      .require_narrow_ring = false};
  }
  return options;
}

std::string options_hash(const ViewOptions& options) {
  nlohmann::ordered_json json;
  json["version"] = version();
  json["preset"] = preset_name(options.preset);
  json["contraction"] = static_cast<int>(options.contraction.method);
  json["contraction-scaling"] = static_cast<int>(options.contraction.scaling);
  echo_fields(json, options.contraction, kContractionFields);
  json["skeleton-scaling"] = static_cast<int>(options.skeleton.scaling);
  echo_fields(json, options.skeleton, kSkeletonFields);
  json["centre"] = options.skeleton.centre;
  json["prune"] = options.skeleton.prune;
  json["suppression"] = static_cast<int>(options.kssm.suppression);
  json["kinematics"] = static_cast<int>(options.kssm.kinematics);
  json["area-weighted-mean"] = options.kssm.area_weighted_mean;
  echo_fields(json, options.kssm, kKssmFields);
  if (options.method != "kssm") {
    json["method"] = options.method;
    echo_fields(json, options.saliency, kMeshSaliencyFields);
    json["saliency-signed"] = options.saliency.signed_curvature;
    json["saliency-area"] = options.saliency.area_kernel;
  }
  json["weight"] = weight_name(options.weight);
  json["finished-graph"] = options.kssm_to_finished_graph;
  json["search"] = strategy_name(options.search.strategy);
  json["base"] = base_name(options.search.base);
  echo_fields(json, options.search, kSearchFields);
  if (options.search.strategy == SearchStrategy::Gradient) {
    echo_fields(json, options.search, kGradientFields);
    json["seed"] = options.search.seed;
  }
  json["epsilon"] = options.search.epsilon;
  json["epsilon-is-fraction"] = options.search.epsilon_is_fraction;
  json["narrow-ring"] = options.search.require_narrow_ring;
  json["prior"] = prior_echo(options.prior);
  json["projection"] = projection_name(options.projection);
  echo_fields(json, options, kViewFields);
  json["distance"] = options.distance_factor ? nlohmann::ordered_json(*options.distance_factor)
                                             : nlohmann::ordered_json(nullptr);
  json["up"] = options.up ? std::string(up_name(*options.up)) : "auto";
  json["size"] = {options.width, options.height};
  if (options.margin != ViewOptions{}.margin) {
    json["margin"] = options.margin;
  }
  json["pictures"] = options.pictures;
  if (options.certify) {
    json["certify"] = true;
  }
  if (!options.focus.empty()) {
    json["focus"] = options.focus;
  }
  if (options.view_set) {
    echo_fields(json, options.view_set->set, kViewSetFields);
    echo_fields(json, *options.view_set, kViewSetRequestFields);
    json["refine"] = options.view_set->set.refine;
    json["level"] = options.view_set->set.level;
    json["select"] = selection_name(options.view_set->selection);
  }

  // FNV-1a, 64 bit: a fingerprint to compare runs by, not a seal.
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = 0; i < 16; ++i) {
    text[15 - i] = kDigits[(hash >> (4 * i)) & 15U];
  }
  return text;
}

std::string_view selection_name(ViewSelection selection) {
  constexpr std::array<std::string_view, 3> kNames{"kssm", "vazquez", "feixas"};
  return kNames[static_cast<std::size_t>(selection)];
}

}  // namespace vantage
