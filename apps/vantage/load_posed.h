// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "vantage/io/model.h"
#include "vantage/pipeline/view_options.h"

namespace vantage {
struct Sidecar;
}

namespace vantage::cli {

class LookFlags;
class OptionFlags;
class Session;

/// \param front that `--front` gave, before a sidecar completed the options.
/// \throw CLI::ValidationError if it is along the axis that is up.
void refuse_front_along_up(const std::optional<UpAxis>& front, const Model& model,
                           const ViewOptions& options);

/// Completes options by a sidecar. Flags that were given come first, `auto` too.
void apply_below(const OptionFlags& flags, Sidecar sidecar, ViewOptions& options);

/// Reads a model and turns it as `options` say, which its sidecar completes first, as apply_below().
/// \param flags what `options` are made of.
/// \param look of its pictures, which the sidecar completes too; null: there are none, and nothing that
///             only they show is read.
Model load_posed(Session& session, const std::string& path, const OptionFlags& flags,
                 ViewOptions& options, LookFlags* look);

}  // namespace vantage::cli
