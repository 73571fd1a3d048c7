// SPDX-License-Identifier: MIT
#include "load_posed.h"

#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/sidecar.h"

#include "look_flags.h"
#include "session.h"

namespace vantage::cli {

Model load_posed(Session& session, const std::string& path, ViewOptions& options, LookFlags* look) {
  const Sidecar sidecar = session.read([&] { return sidecar_of(path); });
  sidecar.apply(options);
  if (look != nullptr) {
    look->suggest(sidecar.style);
  }
  Model model = look != nullptr ? session.load(path, look->reading(options.width, options.height))
                                : session.load(path);
  session.computing([&] { return stand_along_axes(model, options); });
  return model;
}

}  // namespace vantage::cli
