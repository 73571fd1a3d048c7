// SPDX-License-Identifier: MIT
#include "method_flags.h"

#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "input_text.h"
#include "session.h"
#include "settings.h"
#include "terminal.h"

namespace vantage::cli {
namespace {

constexpr int kLargestSide = 16384;

template <class Value>
Value number_or_throw(std::string_view text, const std::string& flag, const std::string& expected) {
  Value value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw CLI::ValidationError(flag,
                               "expected " + expected + ", found '" + std::string(text) + "'");
  }
  return value;
}

const std::map<std::string, UpAxis>& up_axes() {
  static const std::map<std::string, UpAxis> kAxes{{"x", UpAxis::X},       {"y", UpAxis::Y},
                                                   {"z", UpAxis::Z},       {"-x", UpAxis::MinusX},
                                                   {"-y", UpAxis::MinusY}, {"-z", UpAxis::MinusZ}};
  return kAxes;
}

/// ε as "0.1" (a raw sum) or "0.1%" (of the total).
void set_epsilon(SearchOptions& search, std::string text) {
  search.epsilon_is_fraction = !text.empty() && text.back() == '%';
  if (search.epsilon_is_fraction) {
    text.pop_back();
  }
  const double value = number_or_throw<double>(text, "--epsilon", "a number, or a number and %");
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw CLI::ValidationError("--epsilon", "must be finite and not negative");
  }
  search.epsilon = search.epsilon_is_fraction ? value / 100.0 : value;
}

}  // namespace

template <class Part, class Table>
void MethodFlags::add_numbers(CLI::App& app, const std::string& group, Part ViewOptions::*part,
                              const Table& table) {
  for_each_field(table, [&](const auto& field) {
    const auto member = field.member;
    using Value = std::remove_cvref_t<decltype(Part{}.*member)>;
    app.add_option_function<Value>(
           "--" + std::string(field.name),
           [this, part, member](const Value& value) {
             overrides_.emplace_back([=](ViewOptions& o) { (o.*part).*member = value; });
           },
           std::string(field.help))
        ->group(group)
        ->default_str(rounded(static_cast<double>(Part{}.*member)))
        ->check(CLI::Range(field.low, field.high));
  });
}

void MethodFlags::add_to(CLI::App& app, const FlagGroups& groups) {
  app.add_option("--preset", preset_, "default: our choices; paper: the paper's")
      ->check(CLI::IsMember({"default", "paper"}))
      ->capture_default_str()
      ->group("Method");
  app.add_option_function<std::string>(
         "--contraction",
         [this](const std::string& name) {
           const auto method = name == "exact" ? ContractionMethod::Exact : ContractionMethod::Auto;
           overrides_.emplace_back([method](ViewOptions& o) { o.contraction.method = method; });
         },
         "how the surface is contracted: large components by a decimated proxy, or all exactly")
      ->check(CLI::IsMember({"auto", "exact"}))
      ->default_str("auto")
      ->group("Method");
  const std::string details = "Details of contraction and skeleton";
  add_numbers(app, details, &ViewOptions::contraction, kContractionFields);
  add_numbers(app, details, &ViewOptions::skeleton, kSkeletonFields);
  app.add_flag_callback(
         "--no-prune",
         [this] { overrides_.emplace_back([](ViewOptions& o) { o.skeleton.prune = false; }); },
         "keep ends shorter than the local thickness")
      ->group(details);
  app.add_flag_callback(
         "--no-centre",
         [this] { overrides_.emplace_back([](ViewOptions& o) { o.skeleton.centre = false; }); },
         "leave skeleton nodes where the contraction put them")
      ->group(details);
  if (groups.map) {
    add_map_flags(app);
  }
  if (groups.camera) {
    add_camera_flags(app);
  }
  if (groups.search) {
    add_search_flags(app);
  }
  if (groups.picture) {
    add_size_flag(app, [this](int width, int height) {
      overrides_.emplace_back([=](ViewOptions& o) {
        o.width = width;
        o.height = height;
      });
    });
  }
}

void MethodFlags::add_map_flags(CLI::App& app) {
  app.add_option_function<std::string>(
         "--focus",
         [this](const std::string& object) {
           overrides_.emplace_back([object](ViewOptions& o) { o.focus = object; });
         },
         "only this object's significance counts, the others still hide it: name or number as "
         "listed by info")
      ->group("Method");
  app.add_option_function<std::string>(
         "--weight",
         [this](const std::string& name) {
           const bool area = name == "area";
           overrides_.emplace_back([area](ViewOptions& o) {
             o.weight = area ? Weight::Area : Weight::Vertex;
             o.kssm.area_weighted_mean = area;
           });
         },
         "what counts: vertices, or the surface they stand for, however it is cut into faces")
      ->check(CLI::IsMember({"vertex", "area"}))
      ->default_str("vertex")
      ->group("Method");
  app.add_option_function<std::string>(
         "--suppression",
         [this](const std::string& name) {
           const auto kind = name == "mean" ? Suppression::Mean : Suppression::LocalMaxima;
           overrides_.emplace_back([kind](ViewOptions& o) { o.kssm.suppression = kind; });
         },
         "what lowers the share of an even level: its mean, or its local maxima")
      ->check(CLI::IsMember({"mean", "local-maxima"}))
      ->default_str("mean")
      ->group("Method");
  app.add_option_function<std::string>(
         "--kinematics",
         [this](const std::string& name) {
           const auto kind =
               name == "displacement" ? Kinematics::Displacement : Kinematics::Velocity;
           overrides_.emplace_back([kind](ViewOptions& o) { o.kssm.kinematics = kind; });
         },
         "what is summed: the distance to the skeleton, or its change a step")
      ->check(CLI::IsMember({"displacement", "velocity"}))
      ->default_str("displacement")
      ->group("Method");
  app.add_option_function<std::string>(
         "--graph",
         [this](const std::string& name) {
           const bool finished = name == "finished";
           overrides_.emplace_back([=](ViewOptions& o) { o.kssm_to_finished_graph = finished; });
         },
         "skeleton that distances are taken to: before or after centring and pruning")
      ->check(CLI::IsMember({"raw", "finished"}))
      ->default_str("raw")
      ->group("Method");
  add_numbers(app, "Method", &ViewOptions::kssm, kKssmFields);
}

void MethodFlags::add_camera_flags(CLI::App& app) {
  const std::string group = "Camera";
  app.add_option_function<std::string>(
         "--projection",
         [this](const std::string& name) {
           const auto kind =
               name == "perspective" ? Projection::Perspective : Projection::Orthographic;
           overrides_.emplace_back([kind](ViewOptions& o) { o.projection = kind; });
         },
         "of the scoring camera")
      ->check(CLI::IsMember({"perspective", "orthographic"}))
      ->default_str("perspective")
      ->group(group);
  app.add_option_function<double>(
         "--distance",
         [this](const double& factor) {
           overrides_.emplace_back([=](ViewOptions& o) { o.distance_factor = factor; });
         },
         "eye to centre, in radii of the enclosing sphere; default: the sphere fills the view")
      ->check(CLI::Range(1.001, 1e6))
      ->group(group);
  for_each_field(kViewFields, [&](const auto& field) {
    const auto member = field.member;
    app.add_option_function<double>(
           "--" + std::string(field.name),
           [this, member](const double& value) {
             overrides_.emplace_back([=](ViewOptions& o) { o.*member = value; });
           },
           std::string(field.help))
        ->check(CLI::Range(field.low, field.high))
        ->default_str(rounded(ViewOptions{}.*member))
        ->group(group);
  });
  app.add_option_function<std::string>(
         "--up",
         [this](const std::string& name) {
           const auto axis = up_axes().find(name);
           overrides_.emplace_back([=](ViewOptions& o) {
             o.up = axis == up_axes().end() ? std::nullopt : std::optional(axis->second);
           });
         },
         "up axis of the model: x y z -x -y -z, or auto: z for STL, y otherwise, unless the "
         "model clearly stands on the other")
      ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z", "auto"}))
      ->default_str("auto")
      ->group(group);
}

void MethodFlags::add_search_flags(CLI::App& app) {
  const std::string group = "Search";
  app.add_option("--prior", prior_,
                 "what the best view's score is multiplied by: none, upright (how people look at "
                 "things; the default), or a JSON file")
      ->default_str("upright; none with --preset paper")
      ->group(group);
  app.add_option(
         "--search", search_,
         "global: finds what dense finds, by a fraction of its scores; dense: 10242 "
         "directions, then refinement, slow; rapid: the paper's; exhaustive: a direction set; "
         "gradient: Lee's ascent from random starts")
      ->check(CLI::IsMember({"rapid", "exhaustive", "global", "dense", "gradient"}))
      ->default_str("global")
      ->group(group);
  app.add_option_function<std::string>(
         "--base",
         [this](const std::string& name) {
           const auto base = name == "cube" ? ViewSphereBase::Cube : ViewSphereBase::Icosahedron;
           overrides_.emplace_back([base](ViewOptions& o) { o.search.base = base; });
         },
         "polyhedron of the view sphere (default: icosahedron; cube for --search rapid)")
      ->check(CLI::IsMember({"cube", "icosahedron"}))
      ->group(group);
  add_numbers(app, group, &ViewOptions::search, kSearchFields);
  add_numbers(app, group, &ViewOptions::search, kGradientFields);
  app.add_option_function<std::string>(
         "--epsilon",
         [this](const std::string& text) {
           SearchOptions parsed;
           set_epsilon(parsed, text);
           overrides_.emplace_back([parsed](ViewOptions& o) {
             o.search.epsilon = parsed.epsilon;
             o.search.epsilon_is_fraction = parsed.epsilon_is_fraction;
           });
         },
         "rapid search stops when a ring gains less: a raw sum, or a share of the total with %")
      ->default_str("0.1%")
      ->group(group);
  app.add_flag_callback(
         "--certify", [this] { overrides_.emplace_back([](ViewOptions& o) { o.certify = true; }); },
         "search densely as well, and report how far the views found are behind; slow")
      ->group(group);
}

ViewOptions MethodFlags::resolve(std::uint64_t seed) const {
  ViewOptions options = preset_options(preset_ == "paper" ? Preset::Paper : Preset::Default);
  if (search_ == "rapid") {
    options.search.strategy = SearchStrategy::Rapid;
    options.search.base = ViewSphereBase::Cube;
    options.search.subdivisions = 0;
  } else if (!search_.empty()) {
    options.search.strategy = search_ == "global"     ? SearchStrategy::Global
                              : search_ == "dense"    ? SearchStrategy::Dense
                              : search_ == "gradient" ? SearchStrategy::Gradient
                                                      : SearchStrategy::Exhaustive;
    options.search.base = ViewSphereBase::Icosahedron;
    options.search.subdivisions = SearchOptions{}.subdivisions;
  }
  if (!prior_.empty()) {
    options.prior = prior_ == "none"      ? no_prior()
                    : prior_ == "upright" ? upright_prior()
                                          : parse_prior(read_text(prior_), prior_);
  }
  for (const Override& apply : overrides_) {
    apply(options);
  }
  const bool by_gradient = options.search.strategy == SearchStrategy::Gradient;
  if (!by_gradient && options.search.starts != SearchOptions{}.starts) {
    throw CLI::ValidationError("--starts", "goes with --search gradient only");
  }
  options.search.seed = by_gradient ? seed : 0;
  return options;
}

UpAxis up_axis(const std::string& name) {
  return up_axes().at(name);
}

Vec3 parse_vector(const std::string& text, const std::string& flag) {
  Vec3 value = Vec3::Zero();
  std::string_view rest = text;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = axis < 2 ? rest.find(',') : rest.size();
    if (comma == std::string_view::npos) {
      throw CLI::ValidationError(flag, "expected three numbers like 1,0.5,1, found '" + text + "'");
    }
    value[axis] =
        number_or_throw<double>(rest.substr(0, comma), flag, "three numbers like 1,0.5,1");
    rest.remove_prefix(axis < 2 ? comma + 1 : comma);
  }
  return value;
}

void add_common_flags(CLI::App& app, CommonFlags& flags) {
  const std::string group = "Common";
  app.add_flag("--json", flags.json,
               "print the result as JSON, and nothing else, on standard output")
      ->group(group);
  app.add_flag("-q,--quiet", flags.quiet, "no summary, no warnings, no progress")->group(group);
  app.add_flag("-v,--verbose", flags.verbose, "say more")->group(group);
  app.add_option("--threads", flags.threads, "at most this many threads; 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str()
      ->group(group);
  app.add_option("--seed", flags.seed,
                 "start of random sequences: --search gradient draws its starts")
      ->capture_default_str()
      ->group(group);
  if (!app.get_group().empty()) {  // workers are held to limits by whoever starts them
    add_limit_flags(app, flags.limits);
  }
  add_config_flag(app);
}

std::pair<int, int> parse_size(const std::string& text) {
  const std::size_t x = text.find('x');
  const std::string wanted = "WIDTHxHEIGHT like 800x600";
  const int width = number_or_throw<int>(std::string_view(text).substr(0, x), "--size", wanted);
  const int height =
      x == std::string::npos
          ? width
          : number_or_throw<int>(std::string_view(text).substr(x + 1), "--size", wanted);
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) {
    throw CLI::ValidationError("--size", "sides must be between 1 and 16384 pixels");
  }
  return {width, height};
}

void add_size_flag(CLI::App& app, std::function<void(int, int)> take) {
  app.add_option_function<std::string>(
         "--size",
         [take = std::move(take)](const std::string& text) {
           const auto [width, height] = parse_size(text);
           take(width, height);
         },
         "size of pictures in pixels: WIDTHxHEIGHT, or one number for a square")
      ->default_str("800x600")
      ->group("Pictures");
}

}  // namespace vantage::cli
