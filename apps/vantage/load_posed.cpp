// SPDX-License-Identifier: MIT
#include "load_posed.h"

#include <CLI/CLI.hpp>

#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/sidecar.h"

#include "look_flags.h"
#include "option_flags.h"
#include "session.h"

namespace vantage::cli {

void refuse_front_along_up(const std::optional<UpAxis>& front, const Model& model,
                           const ViewOptions& options) {
  const bool is_given = options.up && *options.up != UpAxis::Any;
  const UpAxis up = is_given ? *options.up : default_up(model);
  if (front && up_vector(*front).dot(up_vector(up)) != 0.0) {
    const std::string name(up_name(up));
    throw CLI::ValidationError(
        "--front", std::string(up_name(*front)) + " is along the up axis, " + name +
                       (is_given ? ": give one at right angles to it"
                                 : ", which the format gives; --up says if another axis is up"));
  }
}

void apply_below(const OptionFlags& flags, Sidecar sidecar, ViewOptions& options) {
  if (flags.has("up")) {
    sidecar.up.reset();
  }
  if (flags.has("front")) {
    sidecar.front.reset();
  }
  sidecar.apply(options);
}

Model load_posed(Session& session, const std::string& path, const OptionFlags& flags,
                 ViewOptions& options, LookFlags* look) {
  const Sidecar sidecar = session.read([&] { return sidecar_of(path); });
  const std::optional<UpAxis> front = options.front;
  apply_below(flags, sidecar, options);
  if (look != nullptr) {
    look->suggest(sidecar.style);
  }
  Model model = look != nullptr ? session.load(path, look->reading(options.width, options.height))
                                : session.load(path);
  refuse_front_along_up(front, model, options);
  if (sidecar.front && !options.front && !flags.has("front")) {
    model.notes.emplace_back("the sidecar's front " + std::string(up_name(*sidecar.front)) +
                             " lies along the up that is given and was not taken");
  }
  session.computing([&] { return stand_along_axes(model, options); });
  return model;
}

}  // namespace vantage::cli
