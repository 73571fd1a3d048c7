// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "vantage/pipeline/view_options.h"

#include "option_flags.h"

namespace vantage::cli {

/// Which groups of method flags a command offers.
struct FlagGroups {
  bool map = false;       ///< How KSSM is formed.
  bool saliency = false;  ///< How mesh saliency is.
  bool camera = false;    ///< The scoring camera and up.
  bool search = false;    ///< The search.
  bool picture = false;   ///< --size.
  bool fits = false;      ///< --size is auto unless it is given.
};

/// Turns command line flags into ViewOptions: the preset first, then whatever was given.
class MethodFlags {
 public:
  /// Adds contraction and skeleton flags, --preset, and the groups asked for.
  void add_to(CLI::App& app, const FlagGroups& groups);

  /// The options as asked for on the command line. \param seed of random sequences.
  [[nodiscard]] ViewOptions resolve(std::uint64_t seed = 0);

  /// Whether the option of that name was given.
  [[nodiscard]] bool has(const std::string& name) const { return flags_.has(name); }

  /// What was given.
  [[nodiscard]] const OptionFlags& flags() const { return flags_; }

 private:
  OptionFlags flags_{};
  bool fits_ = false;
};

/// Refuses --up any, of a command that leaves the model as it stands. \throw CLI::ValidationError
void refuse_any_up(const ViewOptions& options);

/// Refuses --distance or --fov from where pictures do not show all of every model.
/// \throw CLI::ValidationError
void refuse_near_eye(const ViewOptions& options);

/// The axis of "x", "-y", … \pre it is one of these.
UpAxis up_axis(const std::string& name);

/// Parses "x,y,z". \throw CLI::ValidationError
Vec3 parse_vector(const std::string& text, const std::string& flag);

/// How a command answers.
enum class Answer { AlsoAsJson, OfItsOwn };

/// Adds --json, if it answers so, -q -v --threads --seed.
struct CommonFlags;
void add_common_flags(CLI::App& app, CommonFlags& flags, Answer answer = Answer::AlsoAsJson);

/// Parses "WIDTHxHEIGHT", or one number for a square. \throw CLI::ValidationError
std::pair<int, int> parse_size(const std::string& text, const std::string& flag);

}  // namespace vantage::cli
