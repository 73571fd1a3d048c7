// SPDX-License-Identifier: MIT
#include "method_flags.h"

#include <charconv>

#include "vantage/pipeline/find_views.h"

#include "session.h"
#include "settings.h"
#include "value_checks.h"

namespace vantage::cli {
namespace {

double number_or_throw(std::string_view text, const std::string& flag) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) {
    throw CLI::ValidationError(
        flag, "expected three numbers like 1,0.5,1, found '" + std::string(text) + "'");
  }
  return value;
}

}  // namespace

void MethodFlags::add_to(CLI::App& app, const FlagGroups& groups) {
  flags_.add_groups(app, {"method"});
  if (groups.map) {
    flags_.add_groups(app, {"map"});
  }
  if (groups.saliency) {
    flags_.add_groups(app, {"saliency"});
  }
  if (groups.camera) {
    flags_.add_groups(app, {"camera"});
  }
  if (groups.search) {
    flags_.add_groups(app, {"search"});
  }
  if (groups.picture) {
    AllOptions start;
    start.view.fit_size = groups.fits;
    flags_.add_groups(app, {"size"}, start);
  }
  fits_ = groups.fits;
}

ViewOptions MethodFlags::resolve(std::uint64_t seed) {
  AllOptions all;
  flags_.apply(all);
  bool is_any_forgotten = false;
  const auto insists_on = [&](std::string_view option) {
    const std::string name(option);
    // That one is asked about first, for what it contradicts, though it may have its effect.
    if (name == "objective" && objective_of(all.view) == all.view.objective && !has("prior")) {
      return flags_.is_typed(name);
    }
    const bool was_given = has(name);
    const bool insists = flags_.insists_on(name);
    is_any_forgotten |= was_given && !insists;
    return insists;
  };
  try {
    check_together(all.view, insists_on);
  } catch (const InvalidInput& error) {
    throw refused(error);
  }
  if (is_any_forgotten) {
    all = {};
    flags_.apply(all);
  }
  all.view.fit_size |= fits_ && !flags_.has("size");
  SearchOptions& search = all.view.search;
  search.seed = search.strategy == SearchStrategy::Gradient ? seed : 0;
  return all.view;
}

void refuse_near_eye(const ViewOptions& options) {
  try {
    check_framing(options);
  } catch (const InvalidInput& error) {
    throw refused(error);
  }
}

void refuse_any_up(const ViewOptions& options) {
  if (options.up == UpAxis::Any) {
    throw CLI::ValidationError(
        "--up", "any turns the model: write it with vantage orient, and take what that writes");
  }
}

UpAxis up_axis(const std::string& name) {
  return static_cast<UpAxis>(index_of_word(kUpWords, name).value());
}

Vec3 parse_vector(const std::string& text, const std::string& flag) {
  Vec3 value = Vec3::Zero();
  std::string_view rest = text;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = axis < 2 ? rest.find(',') : rest.size();
    if (comma == std::string_view::npos) {
      throw CLI::ValidationError(flag, "expected three numbers like 1,0.5,1, found '" + text + "'");
    }
    value[axis] = number_or_throw(rest.substr(0, comma), flag);
    rest.remove_prefix(axis < 2 ? comma + 1 : comma);
  }
  return value;
}

void add_common_flags(CLI::App& app, CommonFlags& flags, Answer answer) {
  const std::string group = "Common";
  if (answer == Answer::AlsoAsJson) {
    app.add_flag("--json", flags.json,
                 "print the result as JSON, and nothing else, on standard output")
        ->group(group);
  }
  app.add_flag("-q,--quiet", flags.quiet, "no summary, no warnings, no progress")->group(group);
  app.add_flag("-v,--verbose", flags.verbose, "say more")->group(group);
  app.add_option("--threads", flags.threads, "at most this many threads; 0: all cores")
      ->check(within(0, 1024))
      ->capture_default_str()
      ->group(group);
  app.add_option("--seed", flags.seed,
                 "start of random sequences: --search gradient draws its starts")
      ->check(whole_from_zero())
      ->capture_default_str()
      ->group(group);
  if (!app.get_group().empty()) {  // workers are held to limits by whoever starts them
    add_limit_flags(app, flags.limits);
  }
  add_config_flag(app);
}

std::pair<int, int> parse_size(const std::string& text, const std::string& flag) {
  ViewOptions options;
  try {
    set_size(options, text);
  } catch (const InvalidInput& error) {
    throw refused(error, flag);
  }
  if (options.fit_size) {
    throw CLI::ValidationError(flag,
                               "must be WIDTHxHEIGHT like 800x600: all pictures are of one size");
  }
  return {options.width, options.height};
}

}  // namespace vantage::cli
