// SPDX-License-Identifier: MIT
#include "vantage/pipeline/view_options.h"

#include <charconv>
#include <cstdint>
#include <string>

#include "vantage/core/error.h"
#include "vantage/core/version.h"
#include "vantage/io/camera_files.h"

#include "core/fingerprint.h"
#include "core/json_text.h"
#include "core/unit_direction.h"
#include "io/files.h"
#include "pipeline/land.h"
#include "pipeline/option_echo.h"

namespace vantage {
namespace {

/// One side of a picture. \throw InvalidInput
int side_of(std::string_view number, std::string_view size) {
  int side = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), side);
  if (error != std::errc{} || end != number.data() + number.size()) {
    throw InvalidInput("option size must be WIDTHxHEIGHT like 800x600, or auto, not '" +
                       std::string(size) + "'");
  }
  if (side < 1 || side > kLargestSide) {
    throw InvalidInput("option size must be between 1 and 16384 pixels a side");
  }
  return side;
}

// Pictures take the aspect of what is seen.
constexpr std::string_view kAuto = "auto";
constexpr std::string_view kAutoOf = "auto:";

// The objective as --prior names it, so that options that are echoed can be set again.
constexpr std::string_view kPeople = "people";

/// Everything of a prior that shapes the result; its name does not.
OrderedJson prior_echo(const ViewPrior& prior) {
  OrderedJson json;
  if (prior.is_uniform) {
    return json;
  }
  for_each_field(kUprightPriorFields, [&](const auto& field) {
    json[std::string(field.name)] = prior.upright.*(field.member);
  });
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
    case UpAxis::Any:
      break;
  }
  return Vec3::UnitY();
}

std::string_view up_name(UpAxis axis) {
  return word_at(kUpWords, static_cast<std::size_t>(axis));
}

UpAxis default_up(ModelFormat format) {
  // A printer's plate lies in x and y.
  const bool is_of_printers =
      format == ModelFormat::Stl || format == ModelFormat::Threemf || format == ModelFormat::Amf;
  return is_of_printers ? UpAxis::Z : UpAxis::Y;
}

UpAxis default_up(const Model& model) {
  if (model.usual_up) {
    return axis_nearest(*model.usual_up);
  }
  const std::optional<LandUp> land = up_of_land(model);
  return land ? land->axis : default_up(model.format);
}

UpAxis default_front(UpAxis up) {
  return axis_nearest(upright_frame(up_vector(up)).front);
}

UpAxis axis_nearest(const Vec3& direction) {
  const Vec3 unit = unit_direction(direction);
  UpAxis nearest = UpAxis::X;
  for (const UpAxis axis : {UpAxis::Y, UpAxis::Z, UpAxis::MinusX, UpAxis::MinusY, UpAxis::MinusZ}) {
    nearest = up_vector(axis).dot(unit) > up_vector(nearest).dot(unit) ? axis : nearest;
  }
  return nearest;
}

ModelFrame::ModelFrame(UpAxis its_up) : ModelFrame(its_up, default_front(its_up)) {}

ModelFrame::ModelFrame(UpAxis its_up, UpAxis its_front) : up(its_up), front(its_front) {
  if (its_up == UpAxis::Any || its_front == UpAxis::Any) {
    throw InvalidInput("up and front of a model's frame must be axes, not any");
  }
  (void)upright_frame(*this);
}

UprightFrame upright_frame(const ModelFrame& frame) {
  return upright_frame(up_vector(frame.up), up_vector(frame.front));
}

ViewOptions preset_options(Preset preset) {
  ViewOptions options;
  options.preset = preset;
  if (preset == Preset::Paper) {
    options.contraction.method = ContractionMethod::Exact;
    options.contraction.scaling = ContractionScaling::Box;
    options.contraction.sheet_limit = 1.0;  // never above the other: nothing is thinned
    options.skeleton.scaling = ContractionScaling::Box;
    options.objective = Objective::Significance;
    options.kssm.level_agreement = 0.0;
    options.skeleton.fit = false;
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
  OrderedJson json = option_echo(options);
  json["version"] = version();
  json["prior"] = prior_echo(options.prior);
  json["view-set"] = options.view_set.has_value();
  if (options.best_view) {
    json["best-view"] = {options.best_view->x(), options.best_view->y(), options.best_view->z()};
  }

  Fingerprint fingerprint;
  fingerprint.add(json_text(json));
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t i = 0; i < 16; ++i) {
    text[15 - i] = kDigits[(fingerprint.value() >> (4 * i)) & 15U];
  }
  return text;
}

Objective objective_of(const ViewOptions& options) {
  const bool is_of_a_paper = options.search.strategy == SearchStrategy::Rapid ||
                             options.search.strategy == SearchStrategy::Gradient;
  return is_of_a_paper ? Objective::Significance : options.objective;
}

std::string_view selection_name(ViewSelection selection) {
  return word_at(kSelectionWords, static_cast<std::size_t>(selection));
}

void set_size(ViewOptions& options, std::string_view text) {
  PictureSize size;
  const bool has_area = text.starts_with(kAutoOf);
  if (text != kAuto) {
    const std::string_view sides = has_area ? text.substr(kAutoOf.size()) : text;
    const std::size_t x = sides.find('x');
    size.width = side_of(sides.substr(0, x), text);
    size.height = x == std::string_view::npos ? size.width : side_of(sides.substr(x + 1), text);
  }
  options.width = size.width;
  options.height = size.height;
  options.fit_size = has_area || text == kAuto;
}

std::string size_text(const ViewOptions& options) {
  const PictureSize usual;
  const bool is_usual = options.width == usual.width && options.height == usual.height;
  if (options.fit_size && is_usual) {
    return std::string(kAuto);
  }
  return std::string(options.fit_size ? kAutoOf : "") + std::to_string(options.width) + "x" +
         std::to_string(options.height);
}

void set_prior(ViewOptions& options, std::string_view text) {
  const std::string name(text);
  // First what may fail: a refused option changes nothing.
  options.prior = name == kPeople || name == "none" ? no_prior()
                  : name == "upright"               ? upright_prior()
                                                    : parse_prior(read_file(name), name);
  options.objective = name == kPeople ? Objective::People : Objective::Significance;
}

std::string prior_text(const ViewOptions& options) {
  return options.objective == Objective::People ? std::string(kPeople) : options.prior.name;
}

}  // namespace vantage
