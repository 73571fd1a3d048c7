// SPDX-License-Identifier: MIT
#include "load_posed.h"

#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/sidecar.h"

#include "look_flags.h"
#include "option_flags.h"
#include "session.h"

namespace vantage::cli {

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
  apply_below(flags, sidecar, options);
  if (look != nullptr) {
    look->suggest(sidecar.style);
  }
  Model model = look != nullptr ? session.load(path, look->reading(options.width, options.height))
                                : session.load(path);
  session.computing([&] { return stand_along_axes(model, options); });
  return model;
}

}  // namespace vantage::cli
